// Which runs are on show: choices of SKU, station and verdict, and every other condition as a chip to take away.
import { type JSX } from "preact";
import { longDay } from "../format/times";
import { language, words } from "../words/language";
import type { Words } from "../words/en";
import { measurementName } from "../words/measurements";
import { CodeChoice } from "./code_choice";
import { addressOf } from "./route";
import { standingWord } from "./runs_table";
import { queryOf, withCondition, type FilterName, type RunFilter } from "./run_filter";
import { useCodes } from "./use_codes";

const VERDICTS = ["PASS", "MARGINAL", "FAIL"] as const;

function go(filter: RunFilter): void {
  window.location.hash = addressOf({ page: "runs", filter });
}

export function RunConditions({ filter }: { filter: RunFilter }): JSX.Element {
  const say = words.value;
  const codes = useCodes();
  const chips = CHIPS.filter((name) => filter[name] !== undefined);
  return (
    <div class="conditions">
      <CodeChoice
        label={say.col_sku}
        value={filter.sku ?? ""}
        codes={codes.skus}
        onChoose={(code) => go(withCondition(filter, "sku", code))}
      />
      <CodeChoice
        label={say.col_station}
        value={filter.station ?? ""}
        codes={codes.stations}
        onChoose={(code) => go(withCondition(filter, "station", code))}
      />
      <CodeChoice
        label={say.col_verdict}
        value={filter.verdict ?? ""}
        codes={VERDICTS}
        nameOf={(verdict) => verdictWord(verdict, say)}
        onChoose={(verdict) => go(withCondition(filter, "verdict", verdict))}
      />
      {chips.map((name) => (
        <a
          key={name}
          class="chip"
          href={addressOf({ page: "runs", filter: withCondition(filter, name, "") })}
          aria-label={say.condition_remove(conditionWord(name, filter, say))}
        >
          {conditionWord(name, filter, say)} <span aria-hidden="true">×</span>
        </a>
      ))}
      {queryOf(filter) !== "" && <a href="#/runs">{say.runs_clear}</a>}
    </div>
  );
}

function verdictWord(verdict: string, say: Words): string {
  const known = VERDICTS.find((one) => one === verdict);
  return known === undefined ? verdict : standingWord(known, say);
}

/** Conditions that come with a link and have no choice of their own. */
const CHIPS = ["without_station", "failed", "since", "until", "counted", "first"] as const;

function conditionWord(name: FilterName, filter: RunFilter, say: Words): string {
  const value = filter[name] ?? "";
  switch (name) {
    case "failed":
      return say.condition_failed(measurementName(value, language.value));
    case "since":
      return say.condition_since(dayWord(value));
    case "until":
      return say.condition_until(dayWord(value));
    case "counted":
      return say.condition_counted;
    case "first":
      return say.condition_first;
    case "without_station":
      return say.without_station;
    default:
      return value;
  }
}

/** An address may hold anything where a day belongs; the service says so. */
function dayWord(day: string): string {
  return /^\d{4}-\d{2}-\d{2}$/.test(day) ? longDay(day) : day;
}
