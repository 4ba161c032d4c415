// One shape of a board: its heights as a picture, what it is worth, and what may be done with it.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getShape } from "../api/client";
import { isEngineer } from "../api/own_role";
import { useResource } from "../api/use_resource";
import type { BoardShape } from "../generated/api";
import { fixed, significant } from "../format/numbers";
import { when } from "../format/times";
import type { Words } from "../words/en";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { BoardHeightsFigure } from "./board_heights_figure";
import { BoardShapeActions } from "./board_shape_actions";
import { Facts, type Fact } from "./facts";
import { ShapeTag } from "./shape_tag";

interface Props {
  /** What the board is called. */
  board: string;
  shape: BoardShape;
  onChange: () => void;
}

export function BoardShapePanel({ board, shape, onChange }: Props): JSX.Element {
  const say = words.value;
  const found = useResource(useCallback((signal: AbortSignal) => getShape(shape.id, signal), [shape.id]));
  return (
    <section class="panel" aria-labelledby="shape-title">
      <div class="panel-head">
        <h2 id="shape-title">{say.shape_version(shape.version)}</h2>
        <ShapeTag state={shape.state} />
      </div>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && <BoardHeightsFigure shape={found.value} />}
      <Facts facts={factsOf(shape, say)} />
      {isEngineer.value && shape.state !== "retired" && (
        <BoardShapeActions board={board} shape={shape} onChange={onChange} />
      )}
    </section>
  );
}

function factsOf(shape: BoardShape, say: Words): Fact[] {
  const { certainty, certified_at: certified, retired_at: retired } = shape;
  const shared = [certainty.focal_px, certainty.centre_px, certainty.mapping_px];
  return [
    { name: say.shape_bend, value: `${fixed(shape.bend_mm, 3)} mm` },
    { name: say.shape_in_plane, value: `${fixed(shape.in_plane_mm, 3)} mm` },
    { name: say.shape_corner_sd, value: `${fixed(certainty.corner_mm, 4)} mm` },
    { name: say.shape_noise, value: `${fixed(shape.sigma_flat_px, 3)} → ${fixed(shape.sigma_px, 3)} px` },
    {
      name: say.shape_camera_sd,
      note: say.shape_camera_sd_note,
      value: `${shared.map((sd) => significant(sd)).join(" / ")} px`,
    },
    { name: say.shape_by, value: `${shape.created_by}, ${when(shape.created_at)}` },
    ...dated(say.shape_certified_fact, certified, shape.certified_by, say),
    ...dated(say.shape_retired_fact, retired, shape.retired_by, say),
  ];
}

function dated(name: string, at: string | null, who: string | null, say: Words): Fact[] {
  return at === null ? [] : [{ name, value: say.shape_since(when(at), who ?? "") }];
}
