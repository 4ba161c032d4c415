// Every measurement of two runs with its verdict, beside each other.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import type { Measurement } from "../generated/api";
import { plain, significant, withUnit } from "../format/numbers";
import { language, words } from "../words/language";
import type { Words } from "../words/en";
import { gateName, measurementName, unitName } from "../words/measurements";
import { pairGates, type GatePair } from "./gate_pairs";
import { StandingTag } from "./runs_table";
import { WideTable } from "./wide_table";

interface Props {
  a: readonly Measurement[];
  b: readonly Measurement[];
}

export function ComparedGates({ a, b }: Props): JSX.Element {
  const say = words.value;
  const [onlyOpen, setOnlyOpen] = useState(false);
  const pairs = pairGates(a, b);
  const open = pairs.filter((pair) => !isPassed(pair.a) || !isPassed(pair.b));
  return (
    <section class="panel" aria-labelledby="gates-title">
      <div class="panel-head">
        <h2 id="gates-title">{say.gates_title}</h2>
        <div class="segments" role="group" aria-label={say.gates_title}>
          <button type="button" aria-pressed={!onlyOpen} onClick={() => setOnlyOpen(false)}>
            {say.gates_filter_all} {pairs.length}
          </button>
          <button type="button" aria-pressed={onlyOpen} onClick={() => setOnlyOpen(true)}>
            {say.gates_filter_open} {open.length}
          </button>
        </div>
      </div>
      <WideTable label={say.gates_title}>
        <table class="compare gates-compared">
          <thead>
            <tr>
              <th scope="col">{say.col_gate}</th>
              <th scope="col" class="number">
                {say.col_limit}
              </th>
              <th scope="col" class="number">
                A
              </th>
              <th scope="col">
                A <span class="visually-hidden">{say.col_verdict}</span>
              </th>
              <th scope="col" class="number">
                B
              </th>
              <th scope="col">
                B <span class="visually-hidden">{say.col_verdict}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {(onlyOpen ? open : pairs).map((pair) => (
              <Row key={`${pair.gate}.${pair.name}`} pair={pair} say={say} />
            ))}
          </tbody>
        </table>
      </WideTable>
    </section>
  );
}

function Row({ pair: { gate, name, a, b }, say }: { pair: GatePair; say: Words }): JSX.Element {
  const limits = [...new Set([a, b].flatMap((one) => (one?.limit == null ? [] : [limitOf(one, one.limit)])))];
  return (
    <tr>
      <th scope="row">
        {measurementName(name, language.value)} <small class="muted">{gateName(gate, say)}</small>
      </th>
      <td class="number muted">{limits.length === 0 ? "–" : limits.join(" | ")}</td>
      <Value measurement={a} say={say} />
      <Value measurement={b} say={say} />
    </tr>
  );
}

function Value({ measurement, say }: { measurement: Measurement | null; say: Words }): JSX.Element {
  if (measurement === null) {
    return (
      <>
        <td class="number muted">–</td>
        <td />
      </>
    );
  }
  const { value, unit, limit, verdict } = measurement;
  return (
    <>
      <td class="number">
        {value === null ? say.not_determined : withUnit(significant(value), unitName(unit, language.value))}
      </td>
      <td>
        {limit === null && verdict === "PASS" ? (
          <span class="muted">{say.no_limit}</span>
        ) : (
          <StandingTag standing={verdict} />
        )}
      </td>
    </>
  );
}

function isPassed(measurement: Measurement | null): boolean {
  return measurement === null || measurement.verdict === "PASS";
}

function limitOf({ comparison, unit }: Measurement, limit: number): string {
  const sign = { "<=": "≤", ">=": "≥", "==": "=" }[comparison] ?? comparison;
  return `${sign} ${withUnit(plain(limit), unitName(unit, language.value))}`;
}
