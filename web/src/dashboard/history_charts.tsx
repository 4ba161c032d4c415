// One small chart for each quantity of a history; a point leads to its run.
import { type JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { coloursOf } from "../drawing/drawing";
import { historyData, historyOptions } from "../drawing/history_chart";
import type { HistoryPoint } from "../drawing/history_points";
import { digitsOfStep, roundStep } from "../drawing/scales";
import { historyRange } from "../drawing/history_points";
import type { PastCalibration } from "../generated/api";
import { digitsForSd, fixed } from "../format/numbers";
import { localeOf, shortDay, when } from "../format/times";
import { dark } from "../look/theme";
import { language, words } from "../words/language";
import { QUANTITIES, quantityOf, type QuantityName } from "./history_quantities";
import { addressOf } from "./route";
import { standingWord } from "./runs_table";
import { mountPlot } from "./mounted_plot";

const HEIGHT_PX = 150;
const STEPS = 5;

interface Props {
  calibrations: readonly PastCalibration[];
  /** The run on show, if any. */
  here: string;
}

export function HistoryCharts({ calibrations, here }: Props): JSX.Element {
  return (
    <div class="history-charts">
      {QUANTITIES.map((name) => (
        <HistoryFigure key={name} name={name} calibrations={calibrations} here={here} />
      ))}
    </div>
  );
}

function HistoryFigure({ name, calibrations, here }: Props & { name: QuantityName }): JSX.Element {
  const say = words.value;
  const [index, setIndex] = useState<number | null>(null);
  const points = useMemo<HistoryPoint[]>(
    () =>
      calibrations.map((one) => ({
        ...quantityOf(one, name),
        verdict: one.verdict,
        isHere: one.run_id === here,
      })),
    [calibrations, here, name],
  );
  const pointed = index === null ? undefined : calibrations[index];
  const open = (): void => {
    if (pointed !== undefined) {
      window.location.hash = addressOf({ page: "run", id: pointed.run_id, capture: "" });
    }
  };
  return (
    <figure class="history-figure">
      <figcaption>
        <h3>
          {name === "rms" ? say.col_rms : <var>{name}</var>} <small class="muted">px</small>
        </h3>
        <span class="key muted">{pointed === undefined ? "" : readOut(pointed, name)}</span>
      </figcaption>
      <div onClick={open} class={pointed === undefined ? "" : "pointed"}>
        <Chart
          points={points}
          calibrations={calibrations}
          label={say.history_chart(name === "rms" ? say.col_rms : name, points.length)}
          onPoint={setIndex}
        />
      </div>
    </figure>
  );
}

function readOut(one: PastCalibration, name: QuantityName): string {
  const { value, sd } = quantityOf(one, name);
  const digits = name === "rms" ? 4 : digitsForSd(sd);
  const spread = sd === null ? "" : ` ± ${fixed(sd, digits)}`;
  return `${when(one.created_at)}: ${fixed(value, digits)}${spread} px · ${standingWord(one.verdict, words.value)}`;
}

interface ChartProps {
  points: readonly HistoryPoint[];
  calibrations: readonly PastCalibration[];
  label: string;
  onPoint: (index: number | null) => void;
}

function Chart({ points, calibrations, label, onPoint }: ChartProps): JSX.Element {
  const place = useRef<HTMLDivElement>(null);
  const spoken = language.value;
  const isDark = dark.value;

  useEffect(() => {
    const { current } = place;
    if (current === null) return undefined;
    const [low, high] = historyRange(points);
    const digits = digitsOfStep(roundStep(high - low, STEPS));
    const chart = {
      points,
      write: (value: number) => fixed(value, digits, spoken),
      name: (at: number) => dayOf(calibrations[at], localeOf(spoken)),
      onPoint,
    };
    const colours = coloursOf(current);
    return mountPlot(current, HEIGHT_PX, (size) => historyOptions(chart, size, colours), historyData(points));
  }, [points, calibrations, onPoint, spoken, isDark]);

  return <div ref={place} class="history-chart" role="img" aria-label={label} />;
}

function dayOf(one: PastCalibration | undefined, locale: string): string {
  return one === undefined ? "" : shortDay(one.created_at.slice(0, 10), locale);
}
