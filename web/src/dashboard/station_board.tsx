// The board that stands at a station, the shape that its solves use, and the way to its page.
import { type JSX } from "preact";
import type { TargetDetail } from "../generated/api";
import { when } from "../format/times";
import { words } from "../words/language";
import { addressOf } from "./route";

export function StationBoard({ board }: { board: TargetDetail | null }): JSX.Element {
  const say = words.value;
  return (
    <div class="station-source">
      <span class="muted">{say.station_board}</span>
      {board === null ? <span class="muted">{say.station_board_none}</span> : <Known board={board} />}
    </div>
  );
}

function Known({ board }: { board: TargetDetail }): JSX.Element {
  const say = words.value;
  const name = board.serial ?? board.spec;
  const shape = board.certified_shape;
  return (
    <>
      <span>{name}</span>
      <span class="muted">
        {shape === null
          ? say.station_board_flat
          : say.station_board_certified(
              shape.version,
              when(shape.certified_at ?? shape.created_at),
              shape.runs,
            )}
      </span>
      <a
        class="station-change"
        href={addressOf({ page: "board", board: board.id, shape: "" })}
        aria-label={say.station_board_open_of(name)}
      >
        {say.station_board_open}
      </a>
    </>
  );
}
