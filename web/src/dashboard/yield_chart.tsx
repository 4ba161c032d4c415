// The chart over the days; the table of days beside it says the same in numbers.
import { type JSX } from "preact";
import { useCallback, useMemo } from "preact/hooks";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawYield, type YieldDay } from "../drawing/yield_drawing";
import { localeOf, shortDay } from "../format/times";
import { language, words, type Language } from "../words/language";
import { daysBetween, firstPassYield, type Sums } from "./yield_sums";

interface Props {
  byDay: readonly { key: string; sums: Sums }[];
  since: string;
  until: string;
}

export function YieldChart({ byDay, since, until }: Props): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const days = useMemo(() => yieldDays(byDay, since, until, spoken), [byDay, since, until, spoken]);
  const draw = useCallback<Draw>(
    (context, size, colours) => drawYield(context, size, days, colours, spoken),
    [days, spoken],
  );
  return (
    <section class="panel" aria-labelledby="days-title">
      <div class="panel-head">
        <h2 id="days-title">{say.yield_over_days}</h2>
        <span class="chart-key">
          <span class="key key-point">● {say.yield_first_pass}</span>
          {(["PASS", "MARGINAL", "FAIL"] as const).map((verdict) => (
            <span key={verdict} class={`key tag-${verdict}`}>
              <svg class="chart-swatch" width="14" height="12" viewBox="0 0 14 12" aria-hidden="true">
                <rect width="14" height="12" fill="currentColor" />
                {verdict !== "PASS" && (
                  <path
                    d={verdict === "FAIL" ? "M-3 12 L9 0 M3 12 L15 0 M9 12 L21 0" : "M0 3 H14 M0 8.5 H14"}
                  />
                )}
              </svg>
              {{ PASS: say.verdict_PASS, MARGINAL: say.verdict_MARGINAL, FAIL: say.verdict_FAIL }[verdict]}
            </span>
          ))}
        </span>
      </div>
      <div class="panel-body yield-chart">
        <Drawing draw={draw} label={say.yield_chart_label(byDay.length)} />
      </div>
    </section>
  );
}

/** All days of the axis, also those without a run. */
function yieldDays(byDay: Props["byDay"], since: string, until: string, spoken: Language): YieldDay[] {
  const known = new Map(byDay.map(({ key, sums }) => [key, sums]));
  return daysBetween(since, until).map((day) => {
    const sums = known.get(day);
    return {
      label: shortDay(day, localeOf(spoken)),
      passed: sums?.passed ?? 0,
      marginal: sums?.marginal ?? 0,
      failed: sums?.failed ?? 0,
      firstPass: sums === undefined ? null : firstPassYield(sums),
    };
  });
}
