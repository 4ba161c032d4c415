// What is said of a board whose newest shape is no longer the certified one.
import { type JSX } from "preact";
import type { Drift } from "../generated/api";
import { plain, significant } from "../format/numbers";
import { words } from "../words/language";

/** Said before the board goes out of its limit, and when it has. */
export function BoardDrift({ drift }: { drift: Drift }): JSX.Element | null {
  const say = words.value;
  if (drift.state === "steady") return null;
  const isOver = drift.state === "over";
  const told = isOver ? say.station_board_over : say.station_board_near;
  return (
    <p class={`notice ${isOver ? "notice-problem" : "notice-warning"}`}>
      {told(significant(drift.worst_mm), plain(drift.limit_mm))}
    </p>
  );
}
