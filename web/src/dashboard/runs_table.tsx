// Runs as a table: verdict by shape, colour and word; each row leads to its run.
import { type JSX } from "preact";
import type { RunSummary } from "../generated/api";
import { fixed, withUnit } from "../format/numbers";
import { exactly, when } from "../format/times";
import { standingOf, VerdictMark, type Standing } from "../shell/verdict_mark";
import type { Words } from "../words/en";
import { words } from "../words/language";
import { purposeName } from "../words/measurements";
import { chosenRuns, withRun } from "./chosen_runs";
import { addressOf } from "./route";

export function RunsTable({ runs }: { runs: readonly RunSummary[] }): JSX.Element {
  const say = words.value;
  return (
    <table class="runs">
      <thead>
        <tr>
          <th scope="col">
            <span class="visually-hidden">{say.history_compare}</span>
          </th>
          <th scope="col">{say.col_verdict}</th>
          <th scope="col">{say.col_serial}</th>
          <th scope="col">{say.col_sku}</th>
          <th scope="col" class="number">
            {say.col_rms}
          </th>
          <th scope="col" class="number wide-only">
            {say.col_captures}
          </th>
          <th scope="col" class="wide-only">
            {say.col_purpose}
          </th>
          <th scope="col" class="wide-only">
            {say.col_station}
          </th>
          <th scope="col" class="number">
            {say.col_when}
          </th>
        </tr>
      </thead>
      <tbody>
        {runs.map((run) => (
          <RunRow key={run.id} run={run} say={say} />
        ))}
      </tbody>
    </table>
  );
}

function RunRow({ run, say }: { run: RunSummary; say: Words }): JSX.Element {
  const standing = standingOf(run);
  const at = run.finished_at ?? run.created_at;
  return (
    <tr>
      <td class="choose">
        {run.state === "finished" && (
          <input
            type="checkbox"
            aria-label={say.pair_choose(run.serial, exactly(at))}
            checked={chosenRuns.value.some(({ id }) => id === run.id)}
            onChange={(event) => {
              chosenRuns.value = withRun(chosenRuns.value, run, event.currentTarget.checked);
            }}
          />
        )}
      </td>
      <td>
        <StandingTag standing={standing} />
      </td>
      <th scope="row">
        <a class="row-link serial" href={addressOf({ page: "run", id: run.id, capture: "" })}>
          {run.serial}
        </a>
      </th>
      <td>
        {run.sku.code} <span class="muted">{say.sku_revision(run.sku.revision)}</span>
      </td>
      <td class="number">{withUnit(fixed(run.rms_px, 3), "px")}</td>
      <td class="number wide-only">{run.poses > 0 ? `${run.captures} / ${run.poses}` : run.captures}</td>
      <td class="wide-only">{purposeName(run.purpose, say)}</td>
      <td class="wide-only">{run.station ?? "–"}</td>
      <td class="number">
        <time dateTime={at} title={exactly(at)}>
          {when(at)}
        </time>
      </td>
    </tr>
  );
}

export function standingWord(standing: Standing, say: Words): string {
  switch (standing) {
    case "PASS":
      return say.verdict_PASS;
    case "MARGINAL":
      return say.verdict_MARGINAL;
    case "FAIL":
      return say.verdict_FAIL;
    case "open":
      return say.state_open;
    case "aborted":
      return say.state_aborted;
    case "finished":
      return say.state_finished;
  }
}

export function StandingTag({ standing }: { standing: Standing }): JSX.Element {
  return (
    <span class={`tag tag-${standing}`}>
      <VerdictMark standing={standing} size={18} />
      {standingWord(standing, words.value)}
    </span>
  );
}
