// Day by day: first-pass yield as a line above, verdicts as stacked bars below. Patterns repeat what colours say.
import { percent } from "../format/numbers";
import type { Colours } from "./drawing";
import { roundStep } from "./scales";
import type { Size } from "./viewport";

export interface YieldDay {
  /** How the day is written under the axis. */
  label: string;
  passed: number;
  marginal: number;
  failed: number;
  /** Share of first runs that passed; null on a day without one. */
  firstPass: number | null;
}

const MARGIN = { left: 50, right: 12, top: 12, bottom: 22 };
const GAP = 22;
/** Share of the height that the line of the yield takes. */
const LINE_SHARE = 0.42;

interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

export function drawYield(
  context: CanvasRenderingContext2D,
  size: Size,
  days: readonly YieldDay[],
  colours: Colours,
  locale: string,
): void {
  const width = size.width - MARGIN.left - MARGIN.right;
  const height = size.height - MARGIN.top - MARGIN.bottom - GAP;
  if (width <= 0 || height <= 0 || days.length === 0) return;
  const above: Box = { left: MARGIN.left, top: MARGIN.top, width, height: height * LINE_SHARE };
  const below: Box = {
    left: MARGIN.left,
    top: MARGIN.top + above.height + GAP,
    width,
    height: height * (1 - LINE_SHARE),
  };
  context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  drawFirstPass(context, above, days, colours, locale);
  drawVerdicts(context, below, days, colours);
  drawDays(context, below, days, colours("plot-axis"));
}

/** The lowest value of the axis: a tenth below the worst day, so that a good line is not drawn as a flat one. */
export function lowestShare(days: readonly YieldDay[]): number {
  const shares = days.flatMap(({ firstPass }) => (firstPass === null ? [] : [firstPass]));
  return Math.max(0, Math.floor(10 * Math.min(0.9, ...shares) - 1e-9) / 10);
}

function drawFirstPass(
  context: CanvasRenderingContext2D,
  box: Box,
  days: readonly YieldDay[],
  colours: Colours,
  locale: string,
): void {
  const low = lowestShare(days);
  const y = (share: number): number => box.top + box.height * (1 - (share - low) / (1 - low));
  for (const share of [low, (1 + low) / 2, 1])
    drawTick(context, box, y(share), percent(share, locale), colours);
  context.strokeStyle = colours("plot-point");
  context.fillStyle = colours("plot-point");
  context.lineWidth = 2;
  context.beginPath();
  let isDrawing = false;
  days.forEach(({ firstPass }, i) => {
    if (firstPass === null) return;
    if (isDrawing) context.lineTo(middle(box, days.length, i), y(firstPass));
    else context.moveTo(middle(box, days.length, i), y(firstPass));
    isDrawing = true;
  });
  context.stroke();
  days.forEach(({ firstPass }, i) => {
    if (firstPass === null) return;
    context.beginPath();
    context.arc(middle(box, days.length, i), y(firstPass), 3.5, 0, 2 * Math.PI);
    context.fill();
  });
}

function drawVerdicts(
  context: CanvasRenderingContext2D,
  box: Box,
  days: readonly YieldDay[],
  colours: Colours,
): void {
  const most = Math.max(1, ...days.map((day) => day.passed + day.marginal + day.failed));
  const step = Math.max(1, roundStep(most, 4));
  const top = Math.ceil(most / step) * step;
  for (let value = 0; value <= top; value += step) {
    drawTick(context, box, box.top + box.height * (1 - value / top), String(value), colours);
  }
  const wide = Math.min(40, (0.7 * box.width) / days.length);
  days.forEach((day, i) => {
    let from = box.top + box.height;
    for (const [count, name] of [
      [day.passed, "pass"],
      [day.marginal, "marginal"],
      [day.failed, "fail"],
    ] as const) {
      const high = (box.height * count) / top;
      if (high === 0) continue;
      const left = middle(box, days.length, i) - wide / 2;
      drawBar(context, { left, top: from - high, width: wide, height: high }, name, colours);
      from -= high;
    }
  });
}

function drawBar(
  context: CanvasRenderingContext2D,
  bar: Box,
  name: "pass" | "marginal" | "fail",
  colours: Colours,
): void {
  context.save();
  context.beginPath();
  context.rect(bar.left, bar.top, bar.width, bar.height);
  context.fillStyle = colours(name);
  context.fill();
  context.clip();
  context.strokeStyle = colours("panel");
  context.lineWidth = 1.5;
  context.beginPath();
  // Stripes rise for FAIL and lie for MARGINAL; PASS has none.
  if (name === "fail") {
    for (let x = -bar.height; x < bar.width; x += 6) {
      context.moveTo(bar.left + x, bar.top + bar.height);
      context.lineTo(bar.left + x + bar.height, bar.top);
    }
  }
  if (name === "marginal") {
    for (let y = 3; y < bar.height; y += 5) {
      context.moveTo(bar.left, bar.top + y);
      context.lineTo(bar.left + bar.width, bar.top + y);
    }
  }
  context.stroke();
  context.restore();
  context.strokeStyle = colours("panel");
  context.lineWidth = 1;
  context.strokeRect(bar.left, bar.top, bar.width, bar.height);
}

function drawTick(
  context: CanvasRenderingContext2D,
  box: Box,
  y: number,
  text: string,
  colours: Colours,
): void {
  const at = Math.round(y) + 0.5;
  context.strokeStyle = colours("plot-grid");
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(box.left, at);
  context.lineTo(box.left + box.width, at);
  context.stroke();
  context.fillStyle = colours("plot-axis");
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.fillText(text, box.left - 7, at);
}

function drawDays(
  context: CanvasRenderingContext2D,
  box: Box,
  days: readonly YieldDay[],
  colour: string,
): void {
  const every = Math.max(1, Math.ceil((60 * days.length) / box.width));
  context.fillStyle = colour;
  context.textAlign = "center";
  context.textBaseline = "top";
  // Counted from today, so that today is always named.
  for (let i = days.length - 1; i >= 0; i -= every) {
    context.fillText(days[i]?.label ?? "", middle(box, days.length, i), box.top + box.height + 7);
  }
}

function middle(box: Box, count: number, i: number): number {
  return box.left + (box.width * (i + 0.5)) / count;
}
