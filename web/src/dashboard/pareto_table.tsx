// Which gates failed in how many runs, worst first; each number leads to its runs.
import { type JSX } from "preact";
import type { FailedGate } from "../generated/api";
import { percent } from "../format/numbers";
import { language, words } from "../words/language";
import { gateName, measurementName } from "../words/measurements";
import type { RunFilter } from "./run_filter";
import { RunsLink } from "./yield_table";

interface Props {
  gates: readonly FailedGate[];
  /** How many runs failed. */
  failed: number;
  filter: RunFilter;
}

export function ParetoTable({ gates, failed, filter }: Props): JSX.Element {
  const say = words.value;
  const most = Math.max(1, ...gates.map((gate) => gate.runs));
  return (
    <section class="panel" aria-labelledby="pareto-title">
      <div class="panel-head">
        <h2 id="pareto-title">{say.pareto_title}</h2>
        <span class="muted">{say.pareto_note}</span>
      </div>
      {gates.length === 0 ? (
        <p class="panel-body muted">{say.pareto_none}</p>
      ) : (
        <table class="pareto">
          <thead>
            <tr>
              <th scope="col">{say.col_gate}</th>
              <th scope="col" aria-hidden="true" />
              <th scope="col" class="number">
                {say.pareto_runs}
              </th>
              <th scope="col" class="number">
                {say.pareto_share}
              </th>
            </tr>
          </thead>
          <tbody>
            {gates.map((gate) => (
              <tr key={`${gate.gate}.${gate.name}`}>
                <th scope="row">
                  {measurementName(gate.name, language.value)}
                  <small class="muted"> {gateName(gate.gate, say)}</small>
                </th>
                <td class="pareto-bar-cell" aria-hidden="true">
                  <svg class="verdict-bar" viewBox="0 0 100 12" preserveAspectRatio="none">
                    <rect class="verdict-bar-FAIL" x="0" y="1" width={(100 * gate.runs) / most} height="10" />
                  </svg>
                </td>
                <td class="number">
                  <RunsLink
                    count={gate.runs}
                    filter={{ ...filter, failed: gate.name, verdict: "FAIL", counted: "true" }}
                  >
                    {gate.runs}
                  </RunsLink>
                </td>
                <td class="number muted">{percent(gate.runs / Math.max(1, failed))}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}
