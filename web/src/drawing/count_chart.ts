// The chart of predicted error against the number of poses: uPlot's options, and what is drawn over its lines.
import type uPlot from "uplot";
import {
  apart,
  columnsOf,
  pointAt,
  powerTicks,
  QUANTITIES,
  rangeOf,
  type Curve,
  type Quantity,
} from "./count_curve";
import type { Colours } from "./drawing";
import { plotAxis } from "./plot_axis";

export interface CountChart {
  curves: readonly Curve[];
  required: number | null;
  write: (value: number) => string;
  words: {
    quantity: Record<Quantity, string>;
    required: (value: string) => string;
    own: (curve: Curve) => string;
    smallest: (curve: Curve) => string;
    axis: string;
  };
  onPoint: (count: number | null) => void;
}

/** The line of each quantity: solid, dashed, dotted. */
export const DASHES: Record<Quantity, number[]> = {
  mapping_mean_px: [],
  mapping_worst_px: [8, 4],
  norm_px: [2, 3],
};
/** One curve is blue, the one it is compared with orange: as the outlines of their poses. */
const INKS = ["plot-point", "plot-chosen"] as const;
/** uPlot's name for an axis of powers. */
const POWERS = 3;
/** Room for the names at the ends of lines, of one set and of two. */
const LABEL_ROOM_PX = [112, 132] as const;
const COUNT_STEPS = [1, 2, 5, 10, 20];
const LABEL_APART_PX = 14;

export function countOptions(
  chart: CountChart,
  size: { width: number; height: number },
  colours: Colours,
): uPlot.Options {
  const [, ...columns] = columnsOf(chart.curves);
  const range = rangeOf(columns.flat(), chart.required);
  const axis = plotAxis(colours);
  return {
    ...size,
    padding: [10, LABEL_ROOM_PX[chart.curves.length > 1 ? 1 : 0], 0, 0],
    legend: { show: false },
    cursor: { y: false, drag: { x: false, y: false, setScale: false }, points: { size: 7 } },
    // eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment -- uPlot's enum has no value at run time
    scales: { x: { time: false }, y: { distr: POWERS, range } },
    axes: [
      { ...axis, label: chart.words.axis, incrs: COUNT_STEPS, labelFont: axis.font, labelSize: 18, size: 28 },
      {
        ...axis,
        size: 64,
        splits: () => powerTicks(...range),
        filter: (_, splits) => splits,
        values: (_, splits) => splits.map((value) => `${chart.write(value)} px`),
      },
    ],
    series: [{}, ...chart.curves.flatMap((_, i) => QUANTITIES.map((quantity) => line(quantity, i, colours)))],
    hooks: {
      draw: [(plot) => drawOver(plot, chart, colours)],
      setCursor: [(plot) => chart.onPoint(countAt(plot))],
    },
  };
}

function line(quantity: Quantity, curve: number, colours: Colours): uPlot.Series {
  return {
    stroke: colours(INKS[curve] ?? "plot-axis"),
    width: quantity === "norm_px" ? 1.5 : 2,
    dash: DASHES[quantity],
    points: { show: false },
    spanGaps: true,
  };
}

function countAt(plot: uPlot): number | null {
  const { idx } = plot.cursor;
  return idx === null || idx === undefined ? null : (plot.data[0][idx] ?? null);
}

/** uPlot's canvas is in device pixels. */
interface Over {
  plot: uPlot;
  context: CanvasRenderingContext2D;
  density: number;
  colours: Colours;
}

function drawOver(plot: uPlot, chart: CountChart, colours: Colours): void {
  const context = plot.ctx;
  const over: Over = { plot, context, density: window.devicePixelRatio, colours };
  context.save();
  context.font = `600 ${11.5 * over.density}px ${getComputedStyle(document.body).fontFamily}`;
  context.textBaseline = "middle";
  if (chart.required !== null) drawRequired(over, chart.required, chart);
  chart.curves.forEach((curve, i) => drawMarks(over, curve, i, chart));
  drawNames(over, chart);
  context.restore();
}

function drawRequired({ plot, context, density, colours }: Over, required: number, chart: CountChart): void {
  const { left, width } = plot.bbox;
  const y = plot.valToPos(required, "y", true);
  context.strokeStyle = colours("ink");
  context.setLineDash([]);
  context.lineWidth = 1.5 * density;
  context.beginPath();
  context.moveTo(left, y);
  context.lineTo(left + width, y);
  context.stroke();
  const text = chart.words.required(chart.write(required));
  context.textAlign = "right";
  tag({ context, density, colours }, text, left + width - 8 * density, y, colours("ink"));
}

/** Text on a ground of its own, so that lines do not run through it. */
function tag(
  { context, density, colours }: Pick<Over, "context" | "density" | "colours">,
  text: string,
  x: number,
  y: number,
  ink: string,
): void {
  const pad = 4 * density;
  const { width } = context.measureText(text);
  const left = context.textAlign === "right" ? x - width : x;
  context.fillStyle = colours("panel");
  context.fillRect(left - pad, y - 8 * density, width + 2 * pad, 16 * density);
  context.fillStyle = ink;
  context.fillText(text, x, y);
}

/** The set's own number of poses as a filled circle, the smallest one that will do as a diamond, both with words. */
function drawMarks(
  { plot, context, density, colours }: Over,
  curve: Curve,
  i: number,
  chart: CountChart,
): void {
  const ink = colours(INKS[i] ?? "plot-axis");
  const { top, height } = plot.bbox;
  const marks: [number, string, "circle" | "diamond"][] = [[curve.own, chart.words.own(curve), "circle"]];
  if (curve.smallest !== null && curve.smallest !== curve.own)
    marks.push([curve.smallest, chart.words.smallest(curve), "diamond"]);
  marks.forEach(([count, words, shape], place) => {
    const value = pointAt(curve, count)?.mapping_mean_px;
    if (value === null || value === undefined) return;
    const x = plot.valToPos(count, "x", true);
    const y = plot.valToPos(value, "y", true);
    context.strokeStyle = context.fillStyle = ink;
    context.lineWidth = density;
    context.setLineDash([3 * density, 3 * density]);
    context.beginPath();
    context.moveTo(x, top);
    context.lineTo(x, top + height);
    context.stroke();
    context.setLineDash([]);
    drawMark(context, x, y, 5.5 * density, shape);
    context.textAlign = "left";
    const row = 2 * i + place;
    tag({ context, density, colours }, words, x + 7 * density, top + (10 + 17 * row) * density, ink);
  });
}

function drawMark(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  radius: number,
  shape: "circle" | "diamond",
): void {
  context.beginPath();
  if (shape === "circle") context.arc(x, y, radius, 0, 2 * Math.PI);
  else {
    const reach = 1.3 * radius;
    context.moveTo(x, y - reach);
    context.lineTo(x + reach, y);
    context.lineTo(x, y + reach);
    context.lineTo(x - reach, y);
    context.closePath();
  }
  context.fill();
}

/** Each line's name at its end. */
function drawNames({ plot, context, density, colours }: Over, { curves, words }: CountChart): void {
  const ends = curves.flatMap((curve, i) =>
    QUANTITIES.flatMap((quantity) => {
      const value = curve.points.at(-1)?.[quantity];
      if (value === null || value === undefined || value <= 0) return [];
      const text =
        curves.length > 1 ? `${curve.name}: ${words.quantity[quantity]}` : words.quantity[quantity];
      return [{ text, ink: colours(INKS[i] ?? "plot-axis"), y: plot.valToPos(value, "y", true) }];
    }),
  );
  const places = apart(
    ends.map(({ y }) => y),
    LABEL_APART_PX * density,
  );
  context.textAlign = "left";
  ends.forEach(({ text, ink }, i) => {
    context.fillStyle = ink;
    context.fillText(text, plot.bbox.left + plot.bbox.width + 6 * density, places[i] ?? 0);
  });
}
