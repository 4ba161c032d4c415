// After a practice: the points against one's own best. No verdict over the whole screen: no vehicle was judged.
import { type JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { fixed } from "../format/numbers";
import type { RunVerdict } from "../generated/protocol";
import { VerdictMark } from "../shell/verdict_mark";
import { words } from "../words/language";
import type { Words } from "../words/en";
import type { Kiosk } from "./kiosk";
import { scoreOf, type Practice, type Score } from "./practice";
import { bestName, isBetter, storeBest, storedBest, type Best } from "./practice_best";

/** A foot that still stands on the switch must not begin the next one. */
const READ_MS = 1500;

interface Props {
  kiosk: Kiosk;
  practice: Practice;
  verdict: RunVerdict;
}

export function PracticeResult({ kiosk, practice, verdict }: Props): JSX.Element {
  const say = words.value;
  const score = scoreOf(practice);
  const [standing] = useState(() => compared(kiosk, score, verdict.verdict !== "FAIL"));
  const again = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    const timer = window.setTimeout(() => again.current?.focus(), READ_MS);
    return () => window.clearTimeout(timer);
  }, []);
  const word = { PASS: say.verdict_PASS, MARGINAL: say.verdict_MARGINAL, FAIL: say.verdict_FAIL }[
    verdict.verdict
  ];
  return (
    <main class="start practice-result" data-practice={score.points}>
      <section class="start-card">
        <p class="start-station">{say.practice_done}</p>
        <h1>{say.practice_of(score.points, score.most)}</h1>
        <p class="start-detail" role="status">
          {remarkOf(standing, score, verdict.verdict !== "FAIL", say)}
        </p>
        <Facts score={score} best={standing.before} hasBadge={kiosk.badge.value !== ""} say={say} />
        <p class="practice-verdict">
          {say.practice_verdict} <VerdictMark standing={verdict.verdict} size={36} /> <b>{word}</b>
        </p>
        <div class="ask-answers">
          <button
            ref={again}
            type="button"
            class="act act-primary"
            onClick={() => kiosk.practise(kiosk.badge.value)}
          >
            {say.practice_again}
          </button>
          <button type="button" class="act" onClick={() => kiosk.nextVehicle()}>
            {say.practice_end}
          </button>
        </div>
      </section>
    </main>
  );
}

interface Standing {
  /** The best of the badge before this run. */
  before: Best | null;
  isBest: boolean;
}

function compared(kiosk: Kiosk, score: Score, hasPassed: boolean): Standing {
  const { run } = kiosk.state.value;
  const badge = kiosk.badge.value;
  if (badge === "" || run === null) return { before: null, isBest: false };
  const name = bestName(badge, run.sku, run.poses.length);
  const before = storedBest(name);
  const isBest = hasPassed && score.isWhole && isBetter(score, before);
  if (isBest) storeBest(name, { points: score.points, took_ms: score.took_ms });
  return { before, isBest };
}

function remarkOf(standing: Standing, score: Score, hasPassed: boolean, say: Words): string {
  if (!score.isWhole) return say.practice_not_whole;
  if (!hasPassed) return say.practice_not_passed;
  return standing.isBest ? say.practice_new_best : "";
}

interface FactsProps {
  score: Score;
  best: Best | null;
  hasBadge: boolean;
  say: Words;
}

function Facts({ score, best, hasBadge, say }: FactsProps): JSX.Element {
  const rows: [string, string][] = [
    [say.practice_total, say.practice_total_of(seconds(score.took_ms), seconds(score.par_ms))],
    [say.practice_under_par, say.practice_under_par_of(score.underPar, score.total)],
    [say.practice_longest, String(score.longest)],
  ];
  if (hasBadge) rows.push([say.practice_best, best === null ? say.practice_best_none : String(best.points)]);
  return (
    <dl class="practice-facts">
      {rows.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

function seconds(ms: number): string {
  return fixed(ms / 1000, 0);
}
