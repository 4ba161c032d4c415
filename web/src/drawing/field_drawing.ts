// Residual vectors where they are in the image: shows what was covered, and a lens model that does not bend enough.
import type { Colours } from "./drawing";
import { arrowEnd, type CornerResidual } from "./residuals";
import { fit, toCanvas, type Point, type Size } from "./viewport";

export interface FieldScene {
  residuals: readonly CornerResidual[];
  chosen: readonly CornerResidual[];
  imageSize: Size;
  gain: number;
}

const MARGIN = 1;

export function drawField(
  context: CanvasRenderingContext2D,
  size: Size,
  scene: FieldScene,
  colours: Colours,
): void {
  const view = fit(scene.imageSize, { width: size.width - 2 * MARGIN, height: size.height - 2 * MARGIN });
  const at = (point: Point): Point => {
    const { x, y } = toCanvas(view, point);
    return { x: x + MARGIN, y: y + MARGIN };
  };
  drawFrame(context, scene.imageSize, at, colours);
  drawVectors(context, scene.residuals, scene.gain, at, colours("plot-point"), 1);
  drawVectors(context, scene.chosen, scene.gain, at, colours("plot-chosen"), 2);
}

function drawFrame(
  context: CanvasRenderingContext2D,
  image: Size,
  at: (point: Point) => Point,
  colours: Colours,
): void {
  const from = at({ x: -0.5, y: -0.5 });
  const to = at({ x: image.width - 0.5, y: image.height - 0.5 });
  context.fillStyle = colours("sunken");
  context.fillRect(from.x, from.y, to.x - from.x, to.y - from.y);
  context.lineWidth = 1;
  context.strokeStyle = colours("plot-grid");
  for (let part = 1; part < 4; part += 1) {
    const x = from.x + ((to.x - from.x) * part) / 4;
    const y = from.y + ((to.y - from.y) * part) / 4;
    context.strokeRect(x, from.y, 0, to.y - from.y);
    context.strokeRect(from.x, y, to.x - from.x, 0);
  }
  context.strokeStyle = colours("line-strong");
  context.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
}

function drawVectors(
  context: CanvasRenderingContext2D,
  residuals: readonly CornerResidual[],
  gain: number,
  at: (point: Point) => Point,
  colour: string,
  width: number,
): void {
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.lineWidth = width;
  context.beginPath();
  for (const residual of residuals) {
    const from = at(residual.reprojected);
    const to = at(arrowEnd(residual, gain));
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
  }
  context.stroke();
  for (const residual of residuals) {
    const { x, y } = at(residual.reprojected);
    context.beginPath();
    context.arc(x, y, width * 1.1, 0, 2 * Math.PI);
    context.fill();
  }
}
