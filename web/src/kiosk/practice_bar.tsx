// Above the picture while somebody practises: the ring that fills with the match, points, streak, and the clock.
import { type JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { fixed } from "../format/numbers";
import { words } from "../words/language";
import type { Kiosk } from "./kiosk";
import { PAR_MS, scoreOf, type Practice } from "./practice";
import { bestName, storedBest } from "./practice_best";

const TICK_MS = 200;
const RADIUS = 42;
const ROUND = 2 * Math.PI * RADIUS;

export function PracticeBar({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const say = words.value;
  const practice = kiosk.practice.value;
  const { run, live } = kiosk.state.value;
  if (practice === null || run === null) return null;
  const { points, most, streak } = scoreOf(practice);
  const badge = kiosk.badge.value;
  const best = badge === "" ? null : storedBest(bestName(badge, run.sku, run.poses.length));
  return (
    <section class="practice" aria-label={say.practice_word}>
      <strong class="practice-word">{say.practice_word}</strong>
      <Ring share={live?.match ?? 0} />
      <Figure name={say.practice_points} value={String(points)} note={`/ ${most}`} />
      <Figure name={say.practice_streak} value={streak === 0 ? "–" : `★ ${streak}`} />
      <Clock practice={practice} />
      {badge !== "" && (
        <Figure name={say.practice_best} value={best === null ? "–" : String(best.points)} note={badge} />
      )}
    </section>
  );
}

function Ring({ share }: { share: number }): JSX.Element {
  const percent = Math.round(100 * share);
  return (
    <svg
      class="practice-ring"
      viewBox="0 0 100 100"
      role="img"
      aria-label={`${words.value.guide_match} ${percent} %`}
    >
      <circle class="ring-ground" cx="50" cy="50" r={RADIUS} />
      <circle
        class={share >= 1 ? "ring-fill ring-full" : "ring-fill"}
        cx="50"
        cy="50"
        r={RADIUS}
        stroke-dasharray={`${share * ROUND} ${ROUND}`}
        transform="rotate(-90 50 50)"
      />
      <text x="50" y="60" text-anchor="middle">
        {share >= 1 ? "✓" : percent}
      </text>
    </svg>
  );
}

function Figure({ name, value, note = "" }: { name: string; value: string; note?: string }): JSX.Element {
  return (
    <p class="practice-figure">
      <span>{name}</span>
      <b>
        {value} {note !== "" && <small>{note}</small>}
      </b>
    </p>
  );
}

function Clock({ practice }: { practice: Practice }): JSX.Element {
  const say = words.value;
  const [now, setNow] = useState(performance.now());
  useEffect(() => {
    const timer = window.setInterval(() => setNow(performance.now()), TICK_MS);
    return () => window.clearInterval(timer);
  }, []);
  const took_ms = practice.since_ms === null ? 0 : Math.max(0, now - practice.since_ms);
  const isOver = took_ms > PAR_MS;
  return (
    <p class={`practice-figure practice-clock ${isOver ? "clock-over" : ""}`}>
      <span>
        {say.practice_time} · {say.practice_par(fixed(PAR_MS / 1000, 0))}
      </span>
      <b>
        {say.practice_seconds(fixed(took_ms / 1000, 1))}{" "}
        <small>{isOver ? say.practice_over : say.practice_under}</small>
      </b>
      <span class="clock-bar" aria-hidden="true">
        <span style={{ width: `${Math.min(100, (100 * took_ms) / PAR_MS)}%` }} />
      </span>
    </p>
  );
}
