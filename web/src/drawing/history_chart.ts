// A small chart of one parameter over the runs of a serial: uPlot's options, and the marks drawn over its axes.
import type uPlot from "uplot";
import type { Colours } from "./drawing";
import { historyRange, type HistoryPoint } from "./history_points";
import { plotAxis } from "./plot_axis";

export interface HistoryChart {
  points: readonly HistoryPoint[];
  write: (value: number) => string;
  /** What the axis says of the run of an index. */
  name: (index: number) => string;
  onPoint: (index: number | null) => void;
  /** A value that they should stay below: a line. */
  limit?: number;
}

const MARK_PX = 5.5;
const CAP_PX = 4;
/** uPlot draws axes from this many px of room per label on. */
const LABEL_ROOM_PX = 62;

export function historyOptions(
  chart: HistoryChart,
  size: { width: number; height: number },
  colours: Colours,
): uPlot.Options {
  const axis = plotAxis(colours);
  const last = chart.points.length - 1;
  return {
    ...size,
    padding: [8, 12, 0, 0],
    legend: { show: false },
    cursor: { y: false, drag: { x: false, y: false, setScale: false }, points: { show: false } },
    scales: {
      x: { time: false, range: [-0.5, last + 0.5] },
      y: { range: historyRange(chart.points, limitRange(chart.limit)) },
    },
    axes: [
      {
        ...axis,
        grid: { show: false },
        incrs: [1, 2, 5, 10, 20, 50, 100],
        space: LABEL_ROOM_PX,
        size: 24,
        values: (_, splits) =>
          splits.map((at) => (Number.isInteger(at) && at >= 0 && at <= last ? chart.name(at) : "")),
      },
      { ...axis, size: 68, space: 26, values: (_, splits) => splits.map(chart.write) },
    ],
    series: [{}, { paths: () => null, points: { show: false } }],
    hooks: {
      draw: [(plot) => drawLimit(plot, chart.limit, colours), (plot) => drawPoints(plot, chart, colours)],
      setCursor: [(plot) => chart.onPoint(plot.cursor.idx ?? null)],
    },
  };
}

/** A limit is seen with the zero that it is counted from. */
function limitRange(limit: number | undefined): number[] {
  return limit === undefined ? [] : [0, limit];
}

export function historyData(points: readonly HistoryPoint[]): uPlot.AlignedData {
  return [points.map((_, i) => i), points.map(({ value }) => value)];
}

function drawLimit(plot: uPlot, limit: number | undefined, colours: Colours): void {
  if (limit === undefined) return;
  const { ctx: context } = plot;
  const density = window.devicePixelRatio;
  const y = plot.valToPos(limit, "y", true);
  context.save();
  context.strokeStyle = colours("fail");
  context.lineWidth = 1.5 * density;
  context.setLineDash([6 * density, 4 * density]);
  context.beginPath();
  context.moveTo(plot.bbox.left, y);
  context.lineTo(plot.bbox.left + plot.bbox.width, y);
  context.stroke();
  context.restore();
}

/** uPlot's canvas is in device pixels. */
function drawPoints(plot: uPlot, { points }: HistoryChart, colours: Colours): void {
  const context = plot.ctx;
  const density = window.devicePixelRatio;
  const { left, top, width, height } = plot.bbox;
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  points.forEach(({ value, sd, verdict, isHere }, i) => {
    const x = plot.valToPos(i, "x", true);
    const y = plot.valToPos(value, "y", true);
    const ink = colours({ PASS: "pass", MARGINAL: "marginal", FAIL: "fail" }[verdict]);
    context.strokeStyle = context.fillStyle = ink;
    context.lineWidth = 1.5 * density;
    if (sd !== null) {
      bar(context, x, plot.valToPos(value - sd, "y", true), plot.valToPos(value + sd, "y", true), density);
    }
    mark(context, x, y, MARK_PX * density, verdict);
    if (isHere) ring(context, x, y, 1.9 * MARK_PX * density, colours("ink"));
  });
  context.restore();
}

function bar(context: CanvasRenderingContext2D, x: number, low: number, high: number, density: number): void {
  const cap = CAP_PX * density;
  context.beginPath();
  context.moveTo(x, low);
  context.lineTo(x, high);
  for (const end of [low, high]) {
    context.moveTo(x - cap, end);
    context.lineTo(x + cap, end);
  }
  context.stroke();
}

/** The verdict's shape: circle, triangle, square on its corner. */
function mark(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  radius: number,
  verdict: HistoryPoint["verdict"],
): void {
  context.beginPath();
  if (verdict === "PASS") context.arc(x, y, radius, 0, 2 * Math.PI);
  else {
    const reach = 1.35 * radius;
    context.moveTo(x, y - reach);
    context.lineTo(x + reach, verdict === "FAIL" ? y : y + 0.8 * reach);
    if (verdict === "FAIL") context.lineTo(x, y + reach);
    context.lineTo(x - reach, verdict === "FAIL" ? y : y + 0.8 * reach);
    context.closePath();
  }
  context.fill();
}

function ring(context: CanvasRenderingContext2D, x: number, y: number, radius: number, ink: string): void {
  context.strokeStyle = ink;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}
