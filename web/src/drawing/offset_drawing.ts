// Offsets between two cameras as arrows over the image.
import type { Colours } from "./drawing";
import type { Zone } from "./heat_grid";
import { drawFrame, imageToCanvas } from "./image_frame";
import { drawZoneLine } from "./image_zones";
import type { Offset } from "./offsets";
import type { Point, Size } from "./viewport";

export interface OffsetScene {
  offsets: readonly Offset[];
  imageSize: Size;
  /** Arrows are drawn so many times longer than they are. */
  gain: number;
  workingZone: Zone;
}

const HEAD_PX = 5;
const HEAD_ANGLE = 0.5;

export function drawOffsets(
  context: CanvasRenderingContext2D,
  size: Size,
  { offsets, imageSize, gain, workingZone }: OffsetScene,
  colours: Colours,
): void {
  const at = imageToCanvas(imageSize, size);
  drawFrame(context, imageSize, at, colours);
  drawZoneLine(context, workingZone, at, colours);
  context.strokeStyle = context.fillStyle = colours("plot-point");
  context.lineWidth = 1.5;
  for (const { from, du, dv } of offsets) {
    drawArrow(context, at(from), at({ x: from.x + gain * du, y: from.y + gain * dv }));
  }
}

function drawArrow(context: CanvasRenderingContext2D, from: Point, to: Point): void {
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  context.beginPath();
  context.arc(from.x, from.y, 1.4, 0, 2 * Math.PI);
  context.fill();
  if (length < 1) return;
  const direction = Math.atan2(to.y - from.y, to.x - from.x);
  const head = Math.min(HEAD_PX, length / 2);
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  for (const side of [-1, 1]) {
    const angle = direction + Math.PI + side * HEAD_ANGLE;
    context.moveTo(to.x, to.y);
    context.lineTo(to.x + head * Math.cos(angle), to.y + head * Math.sin(angle));
  }
  context.stroke();
}
