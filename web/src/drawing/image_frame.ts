// The frame of a camera's image with its quarters: the ground of drawings that are in image coordinates.
import type { Colours } from "./drawing";
import { fit, toCanvas, type Point, type Size } from "./viewport";

const MARGIN = 1;

/** Turns image px into canvas px, the whole image as large as the canvas allows. */
export function imageToCanvas(image: Size, canvas: Size): (point: Point) => Point {
  const view = fit(image, { width: canvas.width - 2 * MARGIN, height: canvas.height - 2 * MARGIN });
  return (point) => {
    const { x, y } = toCanvas(view, point);
    return { x: x + MARGIN, y: y + MARGIN };
  };
}

export function drawFrame(
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
