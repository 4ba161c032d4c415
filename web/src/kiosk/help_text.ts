// The line under the instruction that helps an operator on where the instruction alone does not. Pure.
import type { State } from "../generated/protocol";
import type { Words } from "../words/en";
import type { HintCode } from "./mirror";

/** How long it is said that another pose comes first, in seconds of trying it. */
const CHANGE_SAID_S = 8;
/** Nobody needs to be told at once. */
const AWAY_S = 10;

type Tried = Pick<State, "instead_of" | "tried_s" | "absent_s">;

/** Null: nothing to add. */
export function helpText(code: HintCode, live: Tried, say: Words): string | null {
  if (code === "more-light") return say.help_more_light;
  if (code === "less-light") return say.help_less_light;
  if (code === "show-board" && live.absent_s > AWAY_S) return say.help_board_away;
  return live.instead_of !== null && live.tried_s < CHANGE_SAID_S ? say.help_another_first : null;
}
