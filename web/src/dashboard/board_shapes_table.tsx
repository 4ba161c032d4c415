// The shapes that were learnt of a board: from how many runs, how certain, in use or not, moved by how much.
import { type JSX } from "preact";
import type { BoardShape, TargetDetail } from "../generated/api";
import { fixed, significant } from "../format/numbers";
import { exactly, when } from "../format/times";
import { words } from "../words/language";
import { addressOf } from "./route";
import { DriftTag, ShapeTag } from "./shape_tag";
import { WideTable } from "./wide_table";

interface Props {
  board: TargetDetail;
  shapes: readonly BoardShape[];
  chosen: string;
}

export function BoardShapesTable({ board, shapes, chosen }: Props): JSX.Element {
  const say = words.value;
  return (
    <section class="panel" aria-labelledby="shapes-title">
      <div class="panel-head">
        <h2 id="shapes-title">{say.shapes_title}</h2>
        {shapes.length > 0 && <span class="muted">{say.shapes_note}</span>}
      </div>
      {shapes.length === 0 ? (
        <p class="panel-body muted">{say.shapes_none}</p>
      ) : (
        <WideTable label={say.shapes_caption}>
          <table class="runs shapes">
            <caption class="visually-hidden">{say.shapes_caption}</caption>
            <thead>
              <tr>
                <th scope="col">{say.shape_col_version}</th>
                <th scope="col">{say.shape_col_state}</th>
                <th scope="col">{say.shape_col_learnt}</th>
                <th scope="col" class="number">
                  {say.shape_col_runs}
                </th>
                <th scope="col" class="number">
                  {say.shape_col_bend}, mm
                </th>
                <th scope="col" class="number">
                  {say.shape_col_certainty}, mm
                </th>
                <th scope="col" class="number">
                  {say.shape_col_drift}, mm
                </th>
              </tr>
            </thead>
            <tbody>
              {shapes.map((shape) => (
                <Row key={shape.id} board={board} shape={shape} isChosen={shape.id === chosen} />
              ))}
            </tbody>
          </table>
        </WideTable>
      )}
    </section>
  );
}

interface RowProps {
  board: TargetDetail;
  shape: BoardShape;
  isChosen: boolean;
}

function Row({ board, shape, isChosen }: RowProps): JSX.Element {
  const say = words.value;
  const address = addressOf({
    page: "board",
    board: board.id,
    shape: String(shape.version),
  });
  return (
    <tr class={isChosen ? "chosen" : ""}>
      <th scope="row">
        <a class="row-link" href={address} aria-current={isChosen ? "true" : undefined}>
          {say.shape_version(shape.version)}
        </a>
      </th>
      <td>
        <ShapeTag state={shape.state} />
      </td>
      <td>
        <time dateTime={shape.created_at} title={exactly(shape.created_at)}>
          {when(shape.created_at)}
        </time>
      </td>
      <td class="number">{shape.runs}</td>
      <td class="number">{fixed(shape.bend_mm, 3)}</td>
      <td class="number">{fixed(shape.certainty.corner_mm, 4)}</td>
      <td class="number">
        {shape.drift === null ? (
          "–"
        ) : (
          <>
            {significant(shape.drift.worst_mm)} <DriftTag state={shape.drift.state} />
          </>
        )}
      </td>
    </tr>
  );
}
