// Residual vectors where they are in the image: shows what was covered, and a lens model that does not bend enough.
import type { Colours } from "./drawing";
import { drawFrame, imageToCanvas } from "./image_frame";
import { arrowEnd, type CornerResidual } from "./residuals";
import type { Point, Size } from "./viewport";

export interface FieldScene {
  residuals: readonly CornerResidual[];
  chosen: readonly CornerResidual[];
  /** The residual that is pointed at. */
  pointed: CornerResidual | null;
  imageSize: Size;
  gain: number;
}

export function drawField(
  context: CanvasRenderingContext2D,
  size: Size,
  scene: FieldScene,
  colours: Colours,
): void {
  const at = imageToCanvas(scene.imageSize, size);
  drawFrame(context, scene.imageSize, at, colours);
  drawVectors(context, scene.residuals, scene.gain, at, colours("plot-point"), 1);
  drawVectors(context, scene.chosen, scene.gain, at, colours("plot-chosen"), 2);
  if (scene.pointed !== null) {
    const { x, y } = at(scene.pointed.reprojected);
    context.strokeStyle = colours("ink");
    context.lineWidth = 2;
    context.beginPath();
    context.arc(x, y, 7, 0, 2 * Math.PI);
    context.stroke();
  }
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
