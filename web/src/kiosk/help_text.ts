// The line under the instruction that helps an operator on where the instruction alone does not. Pure.
import type { State, WantedPose } from "../generated/protocol";
import type { Words } from "../words/en";
import type { HintCode } from "./mirror";

/** How long it is said that another pose comes first, in seconds of trying it. */
const CHANGE_SAID_S = 8;
/** Nobody needs to be told at once. */
const AWAY_S = 10;

type Why = Pick<WantedPose, "added_for">;
type Tried = Pick<State, "instead_of" | "tried_s" | "absent_s">;

/** Why a pose that is not of the set is asked for; null for one of the set. */
export function addedText({ added_for }: Why, say: Words): string | null {
  switch (added_for) {
    case "accuracy":
      return say.help_added_accuracy;
    case "weak-capture":
      return say.help_added_weak;
    case "out-of-reach":
      return say.help_added_reach;
    case null:
      return null;
  }
}

/** Null: nothing to add. */
export function helpText(code: HintCode, live: Tried, say: Words, pose: Why | null = null): string | null {
  if (code === "more-light") return say.help_more_light;
  if (code === "less-light") return say.help_less_light;
  if (code === "show-board" && live.absent_s > AWAY_S) return say.help_board_away;
  if (live.tried_s >= CHANGE_SAID_S) return null;
  const added = pose === null ? null : addedText(pose, say);
  return added ?? (live.instead_of === null ? null : say.help_another_first);
}
