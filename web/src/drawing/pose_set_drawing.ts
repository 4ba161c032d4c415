// A pose set in the camera's image: where the board goes, in which order, and which pose is looked at.
import type { Colours } from "./drawing";
import { drawFrame, imageToCanvas } from "./image_frame";
import type { Zone } from "./heat_grid";
import { drawZoneLine } from "./image_zones";
import { spread, type Outline } from "./pose_outlines";
import type { Point, Size } from "./viewport";

export interface PoseSetScene {
  outlines: readonly Outline[];
  /** Index of the pose that is looked at. */
  chosen: number;
  /** Index of the pose under the pointer, here or in another picture of the set. */
  hovered?: number | null;
  imageSize: Size;
  workingZone?: Zone | undefined;
}

const LABEL_RADIUS = 11;

export function drawPoseSet(
  context: CanvasRenderingContext2D,
  size: Size,
  scene: PoseSetScene,
  colours: Colours,
): void {
  const at = imageToCanvas(scene.imageSize, size);
  const placed = scene.outlines.map((outline) => outline.corners.map(at));
  const labels = spread(
    scene.outlines.map(({ centre }) => at(centre)),
    LABEL_RADIUS,
  );
  const hovered = scene.hovered ?? null;
  drawFrame(context, scene.imageSize, at, colours);
  if (scene.workingZone !== undefined) drawZoneLine(context, scene.workingZone, at, colours);
  placed.forEach((corners, i) => {
    if (i !== scene.chosen) drawOutline(context, corners, colours("plot-point"), i === hovered ? 2.5 : 1);
  });
  drawPath(context, labels, colours("plot-axis"));
  const pointed = hovered === null || hovered === scene.chosen ? undefined : placed[hovered];
  if (pointed !== undefined) fillOutline(context, pointed, colours("plot-point"));
  const chosen = placed[scene.chosen];
  if (chosen !== undefined) {
    fillOutline(context, chosen, colours("plot-chosen"));
    drawOutline(context, chosen, colours("plot-chosen"), 2.5);
  }
  labels.forEach((place, i) => {
    if (i !== scene.chosen) drawLabel(context, place, i + 1, colours("panel"), colours("plot-point"));
  });
  const label = labels[scene.chosen];
  if (label !== undefined) {
    drawLabel(context, label, scene.chosen + 1, colours("plot-chosen"), colours("panel"));
  }
}

function trace(context: CanvasRenderingContext2D, corners: readonly Point[]): void {
  context.beginPath();
  corners.forEach(({ x, y }, i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
  context.closePath();
}

function fillOutline(context: CanvasRenderingContext2D, corners: readonly Point[], colour: string): void {
  context.save();
  context.globalAlpha = 0.16;
  context.fillStyle = colour;
  trace(context, corners);
  context.fill();
  context.restore();
}

/** The board's first corner has a dot: it tells which way up the board is held. */
function drawOutline(
  context: CanvasRenderingContext2D,
  corners: readonly Point[],
  colour: string,
  width: number,
): void {
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.lineWidth = width;
  context.lineJoin = "round";
  trace(context, corners);
  context.stroke();
  const [first] = corners;
  if (first === undefined) return;
  context.beginPath();
  context.arc(first.x, first.y, 2 + 1.2 * width, 0, 2 * Math.PI);
  context.fill();
}

/** From each label to the next one, dashed, with an arrow in the middle. */
function drawPath(context: CanvasRenderingContext2D, labels: readonly Point[], colour: string): void {
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.lineWidth = 1.25;
  labels.slice(1).forEach((to, i) => {
    const from = labels[i] ?? to;
    context.setLineDash([5, 4]);
    context.beginPath();
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
    context.stroke();
    context.setLineDash([]);
    if (Math.hypot(to.x - from.x, to.y - from.y) > 4 * LABEL_RADIUS) drawArrow(context, from, to);
  });
}

function drawArrow(context: CanvasRenderingContext2D, from: Point, to: Point): void {
  context.save();
  context.translate((from.x + to.x) / 2, (from.y + to.y) / 2);
  context.rotate(Math.atan2(to.y - from.y, to.x - from.x));
  context.beginPath();
  context.moveTo(6, 0);
  context.lineTo(-4, 4.5);
  context.lineTo(-4, -4.5);
  context.closePath();
  context.fill();
  context.restore();
}

function drawLabel(
  context: CanvasRenderingContext2D,
  { x, y }: Point,
  number: number,
  ground: string,
  ink: string,
): void {
  context.beginPath();
  context.arc(x, y, LABEL_RADIUS, 0, 2 * Math.PI);
  context.fillStyle = ground;
  context.fill();
  context.strokeStyle = ink;
  context.lineWidth = 1.25;
  context.stroke();
  context.fillStyle = ink;
  context.font = `600 12px ${getComputedStyle(document.body).fontFamily}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(String(number), x, y + 0.5);
}
