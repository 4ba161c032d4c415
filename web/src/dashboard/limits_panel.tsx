// The limits by which runs of a revision are judged; its own ones are marked.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { getLimits } from "../api/client";
import { useResource } from "../api/use_resource";
import { percent, plain } from "../format/numbers";
import { Loading, ProblemNotice } from "../shell/notices";
import { language, words } from "../words/language";
import { measurementName } from "../words/measurements";

/** Of these a measurement must reach the limit; of the others it must stay below. */
const AT_LEAST = new Set([
  "parity_separation",
  "contrast",
  "view_separation_px",
  "coverage",
  "smallest_rms_px",
  "monotone_ratio",
]);

export function LimitsPanel({ code, revision }: { code: string; revision: number }): JSX.Element {
  const say = words.value;
  const found = useResource(
    useCallback((signal: AbortSignal) => getLimits(code, revision, signal), [code, revision]),
  );
  return (
    <section class="panel" aria-labelledby="limits-title">
      <div class="panel-head">
        <h2 id="limits-title">{say.limits_title}</h2>
        <span class="muted">{say.limits_note}</span>
      </div>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && (
        <table class="limits">
          <thead>
            <tr>
              <th scope="col">{say.col_gate}</th>
              <th scope="col" class="number">
                {say.col_limit}
              </th>
              <th scope="col" class="number">
                {say.limits_marginal}
              </th>
            </tr>
          </thead>
          <tbody>
            {found.value.limits.map((limit) => (
              <tr key={limit.name} class={limit.is_default ? "" : "limit-own"}>
                <th scope="row">
                  {measurementName(limit.name, language.value)}
                  {!limit.is_default && <small> {say.limits_own}</small>}
                </th>
                <td class="number">
                  {AT_LEAST.has(limit.name) ? "≥" : "≤"} {plain(limit.value)}
                  {limit.name.endsWith("_px") && " px"}
                </td>
                <td class="number muted">{percent(limit.marginal_share)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}
