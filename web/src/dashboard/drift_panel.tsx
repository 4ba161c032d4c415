// How far a board has moved from its certified shape, shape by shape; nothing before one was compared.
import { type JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { coloursOf } from "../drawing/drawing";
import { historyData, historyOptions } from "../drawing/history_chart";
import type { HistoryPoint } from "../drawing/history_points";
import type { BoardShape, Drift, DriftState, Verdict } from "../generated/api";
import { plain, significant } from "../format/numbers";
import { localeOf, shortDay, when } from "../format/times";
import { dark } from "../look/theme";
import { language, words } from "../words/language";
import { mountPlot } from "./mounted_plot";

const HEIGHT_PX = 170;
const MARKS: Record<DriftState, Verdict> = { steady: "PASS", near: "MARGINAL", over: "FAIL" };

type Compared = BoardShape & { drift: Drift };

interface Props {
  /** Newest first. */
  shapes: readonly BoardShape[];
  limitMm: number;
}

export function DriftPanel({ shapes, limitMm }: Props): JSX.Element | null {
  const say = words.value;
  const [index, setIndex] = useState<number | null>(null);
  const compared = useMemo(() => shapes.filter(hasDrift).reverse(), [shapes]);
  if (compared.length === 0) return null;
  const pointed = index === null ? undefined : compared[index];
  return (
    <section class="panel" aria-labelledby="drift-title">
      <div class="panel-head">
        <h2 id="drift-title">{say.drift_title}</h2>
        <span class="muted">{say.drift_key}</span>
      </div>
      <figure class="history-figure drift-figure">
        <figcaption class="muted">
          <span class="key">{pointed === undefined ? say.drift_note : readOut(pointed)}</span>
        </figcaption>
        <Chart compared={compared} limitMm={limitMm} onPoint={setIndex} />
      </figure>
    </section>
  );
}

interface ChartProps {
  compared: readonly Compared[];
  limitMm: number;
  onPoint: (index: number | null) => void;
}

function Chart({ compared, limitMm, onPoint }: ChartProps): JSX.Element {
  const say = words.value;
  const place = useRef<HTMLDivElement>(null);
  const spoken = language.value;
  const isDark = dark.value;
  useEffect(() => {
    const { current } = place;
    if (current === null) return undefined;
    const points = compared.map(pointOf);
    const chart = {
      points,
      write: (value: number) => (value < 0 ? "" : plain(Number(value.toFixed(6)), spoken)),
      name: (at: number) => shortDay((compared[at]?.created_at ?? "").slice(0, 10), localeOf(spoken)),
      onPoint,
      limit: limitMm,
    };
    const colours = coloursOf(current);
    return mountPlot(current, HEIGHT_PX, (size) => historyOptions(chart, size, colours), historyData(points));
  }, [compared, limitMm, onPoint, spoken, isDark]);
  return <div ref={place} class="history-chart" role="img" aria-label={say.drift_chart(compared.length)} />;
}

function hasDrift(shape: BoardShape): shape is Compared {
  return shape.drift !== null;
}

function pointOf({ drift }: Compared): HistoryPoint {
  return { value: drift.worst_mm, sd: null, verdict: MARKS[drift.state], isHere: false };
}

function readOut({ version, created_at: at, drift }: Compared): string {
  return words.value.drift_read(version, when(at), significant(drift.worst_mm), significant(drift.focal_px));
}
