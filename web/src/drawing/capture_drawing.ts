// One capture with its corners, on a canvas. Pure: everything drawn comes in as an argument.
import type { Colours } from "./drawing";
import { arrowEnd, type CornerResidual } from "./residuals";
import { toCanvas, type Point, type Size, type Viewport } from "./viewport";

export interface CaptureScene {
  image: CanvasImageSource | null;
  imageSize: Size;
  detected: readonly Point[];
  residuals: readonly CornerResidual[];
  /** Residual vectors are drawn so many times longer than they are. */
  gain: number;
  show: { detected: boolean; reprojected: boolean; residuals: boolean };
  /** Index of the corner that is pointed at. */
  chosen: number | null;
}

const CIRCLE_PX = 8;
const CROSS_PX = 3.5;
const FIRST_PX = 13;
const CHOSEN_PX = 19;
/** From this many canvas px per image px on, single pixels are shown as squares. */
const CRISP_FROM = 3;

export function drawCapture(
  context: CanvasRenderingContext2D,
  size: Size,
  view: Viewport,
  scene: CaptureScene,
  colours: Colours,
): void {
  context.fillStyle = colours("image-ground");
  context.fillRect(0, 0, size.width, size.height);
  drawImage(context, view, scene);
  const at = (point: Point): Point => toCanvas(view, point);
  if (scene.show.detected) {
    const circles = pathOf(scene.detected.map(at), circle);
    stroke(context, circles, 2, colours("mark-detected"), colours("mark-halo"));
    drawFirstCorner(context, scene.detected[0], at, colours);
  }
  if (scene.show.reprojected) {
    const crosses = pathOf(
      scene.residuals.map((r) => at(r.reprojected)),
      cross,
    );
    stroke(context, crosses, 2, colours("mark-reprojected"), colours("mark-halo"));
  }
  if (scene.show.residuals) drawArrows(context, scene, at, colours);
  drawChosen(context, scene, at, colours);
}

function drawImage(context: CanvasRenderingContext2D, view: Viewport, scene: CaptureScene): void {
  if (scene.image === null) return;
  const corner = toCanvas(view, { x: -0.5, y: -0.5 });
  context.imageSmoothingEnabled = view.scale < CRISP_FROM;
  context.imageSmoothingQuality = "high";
  const { width, height } = scene.imageSize;
  context.drawImage(scene.image, corner.x, corner.y, width * view.scale, height * view.scale);
}

function pathOf(points: readonly Point[], mark: (path: Path2D, point: Point) => void): Path2D {
  const path = new Path2D();
  for (const point of points) mark(path, point);
  return path;
}

function circle(path: Path2D, { x, y }: Point): void {
  path.moveTo(x + CIRCLE_PX, y);
  path.arc(x, y, CIRCLE_PX, 0, 2 * Math.PI);
}

function cross(path: Path2D, { x, y }: Point): void {
  path.moveTo(x - CROSS_PX, y - CROSS_PX);
  path.lineTo(x + CROSS_PX, y + CROSS_PX);
  path.moveTo(x - CROSS_PX, y + CROSS_PX);
  path.lineTo(x + CROSS_PX, y - CROSS_PX);
}

function stroke(
  context: CanvasRenderingContext2D,
  path: Path2D,
  width: number,
  colour: string,
  halo: string,
): void {
  context.lineCap = "round";
  context.globalAlpha = 0.6;
  context.strokeStyle = halo;
  context.lineWidth = width + 2;
  context.stroke(path);
  context.globalAlpha = 1;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke(path);
}

function drawArrows(
  context: CanvasRenderingContext2D,
  scene: CaptureScene,
  at: (point: Point) => Point,
  colours: Colours,
): void {
  const arrows = new Path2D();
  for (const residual of scene.residuals) {
    const from = at(residual.reprojected);
    const to = at(arrowEnd(residual, scene.gain));
    arrows.moveTo(from.x, from.y);
    arrows.lineTo(to.x, to.y);
  }
  stroke(context, arrows, 2, colours("mark-residual"), colours("mark-halo"));
}

/** Corner 0 carries a square: a board that was read turned round is seen at once. */
function drawFirstCorner(
  context: CanvasRenderingContext2D,
  first: Point | undefined,
  at: (point: Point) => Point,
  colours: Colours,
): void {
  if (first === undefined) return;
  const { x, y } = at(first);
  const path = new Path2D();
  path.rect(x - FIRST_PX, y - FIRST_PX, 2 * FIRST_PX, 2 * FIRST_PX);
  stroke(context, path, 2, colours("mark-detected"), colours("mark-halo"));
}

function drawChosen(
  context: CanvasRenderingContext2D,
  scene: CaptureScene,
  at: (point: Point) => Point,
  colours: Colours,
): void {
  const chosen = scene.chosen === null ? undefined : scene.detected[scene.chosen];
  if (chosen === undefined) return;
  const { x, y } = at(chosen);
  const path = new Path2D();
  path.arc(x, y, CHOSEN_PX, 0, 2 * Math.PI);
  stroke(context, path, 1.5, "#ffffff", colours("mark-halo"));
}
