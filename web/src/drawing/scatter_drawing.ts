// Residuals of all views around zero: a cloud that is round, centred and without strays is a good fit.
import { fixed } from "../format/numbers";
import type { Colours } from "./drawing";
import type { CornerResidual } from "./residuals";
import { digitsOfStep, roundStep, symmetricTicks } from "./scales";
import type { Point, Size } from "./viewport";

export interface ScatterScene {
  residuals: readonly CornerResidual[];
  /** Those of the view on show; drawn as diamonds over the others. */
  chosen: readonly CornerResidual[];
  /** The residual that is pointed at. */
  pointed: CornerResidual | null;
  sigma: number;
  /** Half width of the plot, px of residual. */
  limit: number;
}

const MARGIN = { left: 46, right: 12, top: 10, bottom: 36 };

export function drawScatter(
  context: CanvasRenderingContext2D,
  size: Size,
  scene: ScatterScene,
  colours: Colours,
  locale: string,
): void {
  const { side, scale, zero } = scatterFrame(size, scene.limit);
  if (side <= 0) return;
  drawGrid(context, zero, side, scene.limit, colours, locale);
  context.save();
  context.beginPath();
  context.rect(zero.x - side / 2, zero.y - side / 2, side, side);
  context.clip();
  drawRings(context, zero, scene.sigma * scale, colours);
  drawDots(context, zero, scale, scene.residuals, colours("plot-point"));
  drawDiamonds(context, zero, scale, scene.chosen, colours("plot-chosen"), colours("panel"));
  if (scene.pointed !== null) drawPointed(context, zero, scale, scene.pointed, colours("ink"));
  context.restore();
}

export interface ScatterFrame {
  /** Side of the square plot, canvas px. */
  side: number;
  /** Canvas px per px of residual. */
  scale: number;
  /** Where the residual zero is. */
  zero: Point;
}

export function scatterFrame(size: Size, limit: number): ScatterFrame {
  const side = Math.min(size.width - MARGIN.left - MARGIN.right, size.height - MARGIN.top - MARGIN.bottom);
  return {
    side,
    scale: side / 2 / limit,
    zero: {
      x: MARGIN.left + (size.width - MARGIN.left - MARGIN.right) / 2,
      y: MARGIN.top + side / 2,
    },
  };
}

function drawPointed(
  context: CanvasRenderingContext2D,
  zero: Point,
  scale: number,
  { du, dv }: CornerResidual,
  colour: string,
): void {
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(zero.x + du * scale, zero.y + dv * scale, 7, 0, 2 * Math.PI);
  context.stroke();
}

function drawGrid(
  context: CanvasRenderingContext2D,
  zero: Point,
  side: number,
  limit: number,
  colours: Colours,
  locale: string,
): void {
  const scale = side / 2 / limit;
  const most = side < 320 ? 4 : 6;
  const digits = digitsOfStep(roundStep(2 * limit, most));
  context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  context.lineWidth = 1;
  for (const tick of symmetricTicks(limit, most)) {
    context.strokeStyle = tick === 0 ? colours("plot-axis") : colours("plot-grid");
    line(context, zero.x + tick * scale, zero.y - side / 2, zero.x + tick * scale, zero.y + side / 2);
    line(context, zero.x - side / 2, zero.y + tick * scale, zero.x + side / 2, zero.y + tick * scale);
    context.fillStyle = colours("plot-axis");
    const text = fixed(tick, tick === 0 ? 0 : digits, locale);
    context.textAlign = "center";
    context.textBaseline = "top";
    context.fillText(text, zero.x + tick * scale, zero.y + side / 2 + 5);
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.fillText(text, zero.x - side / 2 - 6, zero.y + tick * scale);
  }
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText("Δu / px", zero.x, zero.y + side / 2 + MARGIN.bottom - 1);
  context.save();
  context.translate(zero.x - side / 2 - MARGIN.left + 3, zero.y);
  context.rotate(-Math.PI / 2);
  context.textBaseline = "top";
  context.fillText("Δv / px", 0, 0);
  context.restore();
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  // Half a pixel off, a line of one pixel fills one row instead of two at half strength.
  context.beginPath();
  context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5);
  context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
  context.stroke();
}

function drawRings(context: CanvasRenderingContext2D, zero: Point, radius: number, colours: Colours): void {
  context.strokeStyle = colours("plot-ring");
  context.lineWidth = 1.5;
  for (const [times, dashes] of [
    [1, []],
    [4, [6, 4]],
  ] as const) {
    context.setLineDash([...dashes]);
    context.beginPath();
    context.arc(zero.x, zero.y, radius * times, 0, 2 * Math.PI);
    context.stroke();
  }
  context.setLineDash([]);
}

function drawDots(
  context: CanvasRenderingContext2D,
  zero: Point,
  scale: number,
  residuals: readonly CornerResidual[],
  colour: string,
): void {
  context.fillStyle = colour;
  context.globalAlpha = 0.45;
  for (const { du, dv } of residuals) {
    context.beginPath();
    context.arc(zero.x + du * scale, zero.y + dv * scale, 2.2, 0, 2 * Math.PI);
    context.fill();
  }
  context.globalAlpha = 1;
}

function drawDiamonds(
  context: CanvasRenderingContext2D,
  zero: Point,
  scale: number,
  residuals: readonly CornerResidual[],
  colour: string,
  ground: string,
): void {
  const path = new Path2D();
  for (const { du, dv } of residuals) {
    const [x, y] = [zero.x + du * scale, zero.y + dv * scale];
    path.moveTo(x, y - 4.5);
    path.lineTo(x + 4.5, y);
    path.lineTo(x, y + 4.5);
    path.lineTo(x - 4.5, y);
    path.closePath();
  }
  context.fillStyle = colour;
  context.fill(path);
  context.strokeStyle = ground;
  context.lineWidth = 1;
  context.stroke(path);
}
