// What the cameras of a SKU's revision have in common: mean and spread of each parameter, and whether it judges yet.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getPopulation } from "../api/client";
import { useResource } from "../api/use_resource";
import { digitsForSd, fixed, percent, significant } from "../format/numbers";
import type { Population } from "../generated/api";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";

export function PopulationPanel({ code, revision }: { code: string; revision: number }): JSX.Element {
  const say = words.value;
  const found = useResource(
    useCallback((signal: AbortSignal) => getPopulation(code, revision, signal), [code, revision]),
  );
  return (
    <section class="panel" aria-labelledby="population-title">
      <div class="panel-head">
        <h2 id="population-title">{say.population_title}</h2>
        {found.state === "ready" && <span class="muted">{say.population_count(found.value.units)}</span>}
      </div>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && <Known population={found.value} />}
    </section>
  );
}

function Known({ population }: { population: Population }): JSX.Element {
  const say = words.value;
  const { units, needed, judged_by: judgedBy, start_limits_used: used } = population;
  return (
    <>
      <p class="panel-body muted">
        {judgedBy === null ? say.population_growing(units, needed) : say.population_judging(judgedBy)}
      </p>
      {used !== null && used > 1 && <p class="notice notice-problem">{say.population_wide(percent(used))}</p>}
      {population.parameters.length > 0 && <Parameters population={population} />}
    </>
  );
}

function Parameters({ population }: { population: Population }): JSX.Element {
  const say = words.value;
  return (
    <table class="intrinsics">
      <thead>
        <tr>
          <th scope="col">{say.col_parameter}</th>
          {[say.population_mean, say.population_between, say.population_own].map((title) => (
            <th key={title} scope="col" class="number">
              {title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {population.parameters.map((one) => (
          <tr key={one.name}>
            <th scope="row">
              <var>{one.name}</var>
            </th>
            <td class="number estimate">{fixed(one.mean, digitsForSd(one.sd_between))}</td>
            <td class="number">{significant(one.sd_between)}</td>
            <td class="number muted">{significant(one.sd_own)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
