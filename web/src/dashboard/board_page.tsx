// One board: the shapes that were learnt of it, which one solves use, how it drifts, and what an engineer does.
import { type JSX } from "preact";
import { useMemo, useState } from "preact/hooks";
import { allParts } from "../api/all_parts";
import { getBoard, getShapes } from "../api/client";
import { isEngineer } from "../api/own_role";
import { useKept } from "../api/use_kept";
import { useResource } from "../api/use_resource";
import type { BoardShape, TargetDetail } from "../generated/api";
import { plain, significant } from "../format/numbers";
import { when } from "../format/times";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { BoardDrift } from "./board_drift";
import { BoardLearning } from "./board_learning";
import { BoardShapePanel } from "./board_shape_panel";
import { BoardShapesTable } from "./board_shapes_table";
import { DriftPanel } from "./drift_panel";
import { addressOf } from "./route";
import { useTitle } from "./use_title";

interface Known {
  board: TargetDetail;
  /** Newest first. */
  shapes: BoardShape[];
}

/** Boards change in days; a page that hangs on a wall follows. */
const REFRESH_MS = 30_000;
const refresh = (): number => REFRESH_MS;

type Load = (signal: AbortSignal) => Promise<Known>;

function loaderOf(name: string): Load {
  return async (signal) => {
    const board = await getBoard(name, signal);
    return { board, shapes: await allParts((cursor) => getShapes(board.id, cursor, signal)) };
  };
}

/** `name`: the board's serial or id; `version`: of the shape on show, or nothing. */
export function BoardPage({ name, version }: { name: string; version: string }): JSX.Element {
  const say = words.value;
  // Another function loads again.
  const [load, setLoad] = useState(() => loaderOf(name));
  const found = useKept(useResource(load, refresh));
  const title = found.state === "ready" ? nameOf(found.value.board) : name;
  useTitle(say.board_title(title));
  return (
    <>
      <div class="page-head">
        <h1>{say.board_title(title)}</h1>
        {found.state === "ready" && <code>{found.value.board.spec}</code>}
        <nav class="page-links" aria-label={say.board_title(title)}>
          {found.state === "ready" && (
            <a href={addressOf({ page: "target", spec: found.value.board.spec })}>
              {say.target_print_or_show}
            </a>
          )}
          <a href={addressOf({ page: "targets" })}>{say.board_all}</a>
        </nav>
      </div>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && (
        <Panels known={found.value} version={version} onChange={() => setLoad(() => loaderOf(name))} />
      )}
    </>
  );
}

interface PanelsProps {
  known: Known;
  version: string;
  onChange: () => void;
}

function Panels({ known: { board, shapes }, version, onChange }: PanelsProps): JSX.Element {
  const chosen = useMemo(() => chosenOf(shapes, version), [shapes, version]);
  return (
    <>
      <Standing board={board} />
      <div class="columns columns-half">
        <div class="board-left">
          <BoardShapesTable board={board} shapes={shapes} chosen={chosen?.id ?? ""} />
          <DriftPanel shapes={shapes} limitMm={board.drift_limit_mm} />
          {isEngineer.value && <BoardLearning board={board.id} onLearnt={onChange} />}
        </div>
        {chosen !== null && (
          <BoardShapePanel key={chosen.id} board={nameOf(board)} shape={chosen} onChange={onChange} />
        )}
      </div>
    </>
  );
}

/** What solves use now, and whether the board still is so. */
function Standing({ board: { certified_shape: used, drift } }: { board: TargetDetail }): JSX.Element {
  const say = words.value;
  return (
    <>
      <p>
        {used === null
          ? say.board_flat
          : say.board_in_use(used.version, when(used.certified_at ?? used.created_at))}
        {drift?.state === "steady" &&
          ` ${say.board_steady(significant(drift.worst_mm), plain(drift.limit_mm))}`}
      </p>
      {drift !== null && <BoardDrift drift={drift} />}
    </>
  );
}

function nameOf({ serial, spec }: TargetDetail): string {
  return serial ?? spec;
}

/** The shape of a version, else the one in use, else the newest. */
function chosenOf(shapes: readonly BoardShape[], version: string): BoardShape | null {
  return (
    shapes.find((shape) => String(shape.version) === version) ??
    shapes.find(({ state }) => state === "certified") ??
    shapes[0] ??
    null
  );
}
