// The verdict, to be read from two metres: shape, colour, word; then whose it is, and why.
import { type JSX } from "preact";
import type { Measurement, RunDetail } from "../generated/api";
import { fixed, withUnit } from "../format/numbers";
import { exactly } from "../format/times";
import { standingOf, VerdictMark } from "../shell/verdict_mark";
import { adviceOf } from "../words/advice";
import type { Words } from "../words/en";
import { language, words } from "../words/language";
import { gateName, measurementName, purposeName } from "../words/measurements";
import { addressOf } from "./route";
import { standingWord } from "./runs_table";
import { reasonsOf } from "./reasons";

const REASONS_SHOWN = 4;

export function VerdictBanner({ run }: { run: RunDetail }): JSX.Element {
  const say = words.value;
  const standing = standingOf(run);
  return (
    <section class={`banner banner-${standing}`} aria-labelledby="verdict">
      <div class="banner-verdict">
        <VerdictMark standing={standing} size={104} />
        <h1 id="verdict">
          <span class="banner-word">{standingWord(standing, say)}</span>
          <span class="visually-hidden"> {run.serial}</span>
        </h1>
        <div class="banner-whose">
          <span class="banner-serial serial">{run.serial}</span>
          <span>
            {run.sku.code} {say.sku_revision(run.sku.revision)} · {purposeName(run.purpose, say)}
            {run.station !== null && ` · ${run.station}`}
          </span>
          {run.rms_px !== null && (
            <span>
              {say.col_rms} {withUnit(fixed(run.rms_px, 3), "px")}
            </span>
          )}
        </div>
      </div>
      <div class="banner-why">
        <Why run={run} say={say} />
        <p class="banner-facts">
          <span>
            {say.run_started} <time dateTime={run.created_at}>{exactly(run.created_at)}</time>
          </span>
          {run.finished_at !== null && (
            <span>
              {say.run_finished} <time dateTime={run.finished_at}>{exactly(run.finished_at)}</time>
            </span>
          )}
          <span>
            {say.run_of} <code>{run.id}</code>
          </span>
          <a href={addressOf({ page: "vehicle", serial: run.serial })}>{say.run_history}</a>
        </p>
      </div>
    </section>
  );
}

function Why({ run, say }: { run: RunDetail; say: Words }): JSX.Element {
  if (run.state === "aborted") return <p class="banner-lead">{say.banner_aborted}</p>;
  if (run.result === null) return <p class="banner-lead">{say.banner_open(run.captures, run.poses)}</p>;
  if (run.result.verdict === "PASS") return <p class="banner-lead">{say.banner_pass}</p>;
  const reasons = reasonsOf(run.result.gates);
  return (
    <>
      <p class="banner-lead">{run.result.verdict === "FAIL" ? say.banner_fail : say.banner_marginal}</p>
      <ul class="reasons">
        {reasons.slice(0, REASONS_SHOWN).map((gate) => (
          <Reason key={`${gate.gate}.${gate.name}`} gate={gate} say={say} />
        ))}
      </ul>
      {reasons.length > REASONS_SHOWN && <p>{say.banner_more(reasons.length - REASONS_SHOWN)}</p>}
    </>
  );
}

function Reason({ gate, say }: { gate: Measurement; say: Words }): JSX.Element {
  const advice = adviceOf(gate, language.value, say);
  return (
    <li>
      <VerdictMark standing={gate.verdict} size={20} />
      <span>
        <strong>
          {gateName(gate.gate, say)}: {measurementName(gate.name, language.value)}.
        </strong>{" "}
        <span lang={advice.lang}>{advice.all}</span>
      </span>
    </li>
  );
}
