// The figures of all shown days in large: first-pass yield and the three verdicts, each leading to its runs.
import { type JSX } from "preact";
import { StandingTag } from "./runs_table";
import { words } from "../words/language";
import type { RunFilter } from "./run_filter";
import { firstPassYield, runsOf, type Sums } from "./yield_sums";
import { RunsLink, shareText } from "./yield_table";

export function YieldFigures({ sums, filter }: { sums: Sums; filter: RunFilter }): JSX.Element {
  const say = words.value;
  const verdicts = [
    ["PASS", sums.passed],
    ["MARGINAL", sums.marginal],
    ["FAIL", sums.failed],
  ] as const;
  return (
    <section class="panel figures" aria-label={say.yield_first_pass}>
      <div class="figure-first">
        <span class="figure-name">{say.yield_first_pass}</span>
        <strong class="figure-value">{shareText(firstPassYield(sums))}</strong>
        <RunsLink count={sums.firstRuns} filter={{ ...filter, first: "true" }}>
          {say.yield_first_of(sums.firstPassed, sums.firstRuns)}
        </RunsLink>
      </div>
      {verdicts.map(([verdict, count]) => (
        <div key={verdict}>
          <StandingTag standing={verdict} />
          <strong class="figure-value">
            <RunsLink count={count} filter={{ ...filter, verdict, counted: "true" }}>
              {count}
            </RunsLink>
          </strong>
          <span class="muted">{shareText(count / Math.max(1, runsOf(sums)))}</span>
        </div>
      ))}
      <div>
        <span class="figure-name">{say.yield_runs}</span>
        <strong class="figure-value">
          <RunsLink count={runsOf(sums)} filter={{ ...filter, counted: "true" }}>
            {runsOf(sums)}
          </RunsLink>
        </strong>
      </div>
    </section>
  );
}
