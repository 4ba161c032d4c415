// What stands under a list of runs while some are chosen: which, and the way to their comparison.
import { type JSX } from "preact";
import { words } from "../words/language";
import { chosenRuns, pairOf } from "./chosen_runs";
import { addressOf } from "./route";

export function CompareChosen(): JSX.Element | null {
  const say = words.value;
  const chosen = chosenRuns.value;
  if (chosen.length === 0) return null;
  const pair = pairOf(chosen);
  return (
    <div class="compare-chosen" role="status">
      <span>{say.pair_chosen(chosen.map(({ serial }) => serial).join(", "))}</span>
      {pair === null ? (
        <span class="muted">{say.pair_one_more}</span>
      ) : (
        <a href={addressOf({ page: "compare", a: pair[0].id, b: pair[1].id })}>{say.pair_compare}</a>
      )}
      <button type="button" onClick={() => (chosenRuns.value = [])}>
        {say.pair_let_go}
      </button>
    </div>
  );
}
