// Every measurement against its limit: value, limit, a bar of how much of the limit is used, what to do.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import type { Measurement } from "../generated/api";
import { barEnd, LIMIT_AT, usedShare } from "../drawing/margin";
import { percent, plain, significant, withUnit } from "../format/numbers";
import { adviceOf } from "../words/advice";
import type { Words } from "../words/en";
import { language, words } from "../words/language";
import { gateName, measurementName, unitName } from "../words/measurements";
import { groupGates, type GateGroup } from "./reasons";
import { StandingTag } from "./runs_table";

/** Shares of the limit beyond this are only called many. */
const MOST_WRITTEN = 10;

export function GatesTable({ gates }: { gates: readonly Measurement[] }): JSX.Element {
  const say = words.value;
  const [onlyOpen, setOnlyOpen] = useState(false);
  const shown = onlyOpen ? gates.filter((gate) => gate.verdict !== "PASS") : gates;
  return (
    <section class="panel gates-panel" aria-labelledby="gates-title">
      <div class="panel-head">
        <h2 id="gates-title">{say.gates_title}</h2>
        <div class="segments" role="group" aria-label={say.gates_title}>
          <button type="button" aria-pressed={!onlyOpen} onClick={() => setOnlyOpen(false)}>
            {say.gates_filter_all} {gates.length}
          </button>
          <button type="button" aria-pressed={onlyOpen} onClick={() => setOnlyOpen(true)}>
            {say.gates_filter_open} {gates.filter((gate) => gate.verdict !== "PASS").length}
          </button>
        </div>
      </div>
      {shown.length === 0 ? (
        <p class="panel-body muted">{say.gates_all_passed}</p>
      ) : (
        <table class="gates">
          <caption class="visually-hidden">{say.gates_caption}</caption>
          <thead>
            <tr>
              <th scope="col">{say.col_verdict}</th>
              <th scope="col">{say.col_gate}</th>
              <th scope="col" class="number">
                {say.col_value}
              </th>
              <th scope="col" class="number">
                {say.col_limit}
              </th>
              <th scope="col" class="bar-column">
                {say.col_margin}
              </th>
              <th scope="col" class="advice-column">
                {say.col_advice}
              </th>
            </tr>
          </thead>
          {groupGates(shown).map((group) => (
            <Group key={group.gate} group={group} say={say} />
          ))}
        </table>
      )}
    </section>
  );
}

function Group({ group, say }: { group: GateGroup; say: Words }): JSX.Element {
  return (
    <tbody>
      <tr class="gate-group">
        <th scope="rowgroup" colSpan={6}>
          {gateName(group.gate, say)}
        </th>
      </tr>
      {group.measurements.map((measurement, i) => (
        <Row key={`${measurement.name}.${i}`} measurement={measurement} say={say} />
      ))}
    </tbody>
  );
}

function Row({ measurement, say }: { measurement: Measurement; say: Words }): JSX.Element {
  const { name, value, limit, comparison, verdict } = measurement;
  const advice = adviceOf(measurement, language.value, say);
  const unit = unitName(measurement.unit, language.value);
  return (
    <tr class={`gate gate-${verdict}`}>
      <td>
        {isJudged(measurement) ? (
          <StandingTag standing={verdict} />
        ) : (
          <span class="muted">{say.no_limit}</span>
        )}
      </td>
      <th scope="row">
        {measurementName(name, language.value)}
        <small class="advice-inline" lang={advice.lang}>
          {advice.all}
        </small>
      </th>
      <td class="number">{value === null ? say.not_determined : withUnit(significant(value), unit)}</td>
      <td class="number muted">
        {limit === null ? "–" : `${sign(comparison)} ${withUnit(plain(limit), unit)}`}
      </td>
      <td class="bar-column">
        <Bar measurement={measurement} say={say} />
      </td>
      <td class="advice-column" lang={advice.lang}>
        {advice.all}
      </td>
    </tr>
  );
}

/** A value without a limit is told, not judged. */
function isJudged({ limit, verdict }: Measurement): boolean {
  return limit !== null || verdict !== "PASS";
}

function sign(comparison: string): string {
  return { "<=": "≤", ">=": "≥", "==": "=" }[comparison] ?? comparison;
}

function Bar({ measurement, say }: { measurement: Measurement; say: Words }): JSX.Element | null {
  const share = usedShare(measurement.value, measurement.limit, measurement.comparison);
  if (share === null) return null;
  const written = Number.isFinite(share) && share < MOST_WRITTEN ? percent(share) : "≫ 100 %";
  const used = say.margin_used(written);
  const tick = 100 * LIMIT_AT;
  return (
    <span class="margin">
      <svg class="margin-bar" viewBox="0 0 100 14" preserveAspectRatio="none" role="img" aria-label={used}>
        <title>{used}</title>
        <rect class="margin-ground" x="0" y="4" width="100" height="6" />
        <rect class="margin-good" x="0" y="4" width={tick} height="6" />
        <rect
          class={`margin-value margin-${measurement.verdict}`}
          x="0"
          y="4"
          width={100 * barEnd(share)}
          height="6"
        />
        <rect class="margin-limit" x={tick - 0.7} y="0" width="1.4" height="14" />
      </svg>
      <span class="margin-share" aria-hidden="true">
        {written}
      </span>
    </span>
  );
}
