// The result over the whole screen, for eyes two metres away: shape, word, what to do, and why.
import { type JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { significant, plain, withUnit } from "../format/numbers";
import type { GateLine, RunVerdict } from "../generated/protocol";
import { VerdictMark } from "../shell/verdict_mark";
import { language, words } from "../words/language";
import { adviceOf } from "../words/advice";
import { gateName, measurementName, unitName } from "../words/measurements";
import type { Words } from "../words/en";
import type { Kiosk } from "./kiosk";
import { PurposeTag } from "./purpose_tag";
import { remedyOf } from "./said";

/** As many as fit under the verdict on a small screen; the result has all of them. */
const REASONS_SHOWN = 2;
/** A foot that still stands on the switch must not wipe the verdict away. */
const READ_MS = 1500;

export function VerdictScreen({ kiosk, verdict }: { kiosk: Kiosk; verdict: RunVerdict }): JSX.Element {
  const say = words.value;
  const { run } = kiosk.state.value;
  const standing = verdict.verdict;
  const toDo = {
    PASS: say.verdict_do_PASS,
    MARGINAL: say.verdict_do_MARGINAL,
    FAIL: say.verdict_do_FAIL,
  }[standing];
  const word = { PASS: say.verdict_PASS, MARGINAL: say.verdict_MARGINAL, FAIL: say.verdict_FAIL }[standing];
  const open = firstOfEachGate(verdict.gates.filter((gate) => gate.verdict !== "PASS"));
  return (
    <main
      class={`verdict verdict-${standing} ${open.length > 0 ? "verdict-reasoned" : ""}`}
      data-verdict={standing}
    >
      <div class="verdict-head">
        <VerdictMark standing={standing} size={240} />
        <h1 class="verdict-word">{word}</h1>
      </div>
      <p class="verdict-serial">
        {verdict.serial} {run !== null && <PurposeTag purpose={run.purpose} />}
      </p>
      <p class="verdict-do" role="alert">
        {toDo}
      </p>
      {open.length > 0 && <Reasons gates={open} say={say} />}
      <NextVehicle kiosk={kiosk} say={say} />
    </main>
  );
}

/** What one gate has to say twice has the same remedy; the service puts the worst first. */
function firstOfEachGate(gates: readonly GateLine[]): GateLine[] {
  return gates.filter((gate, i) => gates.findIndex((other) => other.gate === gate.gate) === i);
}

function Reasons({ gates, say }: { gates: readonly GateLine[]; say: Words }): JSX.Element {
  return (
    <section class="why">
      <ul aria-label={say.verdict_why}>
        {gates.slice(0, REASONS_SHOWN).map((gate) => (
          <Reason key={`${gate.gate}.${gate.name}`} gate={gate} say={say} />
        ))}
      </ul>
      {gates.length > REASONS_SHOWN && (
        <p class="why-more">{say.verdict_more(gates.length - REASONS_SHOWN)}</p>
      )}
    </section>
  );
}

function Reason({ gate, say }: { gate: GateLine; say: Words }): JSX.Element {
  const unit = unitName(gate.unit, language.value);
  const measured = gate.value === null ? say.not_determined : withUnit(significant(gate.value), unit);
  const limit = gate.limit === null ? "" : ` (${sign(gate.comparison)} ${withUnit(plain(gate.limit), unit)})`;
  const advice = adviceOf(gate, language.value, say);
  const remedy = remedyOf(gate.gate, say);
  return (
    <li>
      <strong>
        {gateName(gate.gate, say)}: {measurementName(gate.name, language.value)} {measured}
        {limit}
      </strong>
      <span class="why-do" lang={remedy === null ? advice.lang : language.value}>
        {remedy === null ? advice.all : `${advice.wrong} ${remedy}`.trim()}
      </span>
    </li>
  );
}

function sign(comparison: string): string {
  return { "<=": "≤", ">=": "≥", "==": "=" }[comparison] ?? comparison;
}

function NextVehicle({ kiosk, say }: { kiosk: Kiosk; say: Words }): JSX.Element {
  const button = useRef<HTMLButtonElement>(null);

  useEffect(() => {
    const timer = window.setTimeout(() => button.current?.focus(), READ_MS);
    return () => window.clearTimeout(timer);
  }, []);

  return (
    <footer class="verdict-next">
      <button ref={button} type="button" class="act act-next" onClick={() => kiosk.nextVehicle()}>
        {say.verdict_next} <kbd>Enter</kbd>
      </button>
      <span>{say.verdict_next_detail}</span>
    </footer>
  );
}
