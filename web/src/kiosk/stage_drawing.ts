// The live picture with the wanted board, the seen board and arrows, on a canvas. Pure: all of it comes in.
// Dashes are wanted, solid lines are seen; colours only repeat it.
import type { Colours } from "../drawing/drawing";
import { fit, toCanvas, type Point, type Size, type Viewport } from "../drawing/viewport";
import { arrowShape, type Arrow } from "./arrows";
import type { Outline, StageScene } from "./stage_scene";

export interface StagePicture {
  image: CanvasImageSource | null;
  imageSize: Size;
  isMirrored: boolean;
}

/** Where image px land on the canvas, px; all lines are as thick on every screen. */
interface Pen {
  context: CanvasRenderingContext2D;
  at: (point: Point) => Point;
  unit: number;
  colours: Colours;
}

/** Canvas width at which a unit is one px. */
const UNIT_WIDTH = 1000;

export function drawStage(
  context: CanvasRenderingContext2D,
  size: Size,
  picture: StagePicture,
  scene: StageScene | null,
  colours: Colours,
): void {
  context.fillStyle = colours("image-ground");
  context.fillRect(0, 0, size.width, size.height);
  const view = fit(picture.imageSize, size);
  context.save();
  if (picture.isMirrored) {
    context.translate(size.width, 0);
    context.scale(-1, 1);
  }
  drawPicture(context, picture, view);
  if (scene !== null) {
    const unit = Math.max(0.6, (picture.imageSize.width * view.scale) / UNIT_WIDTH);
    drawScene({ context, at: (point) => toCanvas(view, point), unit, colours }, scene);
  }
  context.restore();
}

function drawPicture(context: CanvasRenderingContext2D, picture: StagePicture, view: Viewport): void {
  if (picture.image === null) return;
  const corner = toCanvas(view, { x: -0.5, y: -0.5 });
  const { width, height } = picture.imageSize;
  context.drawImage(picture.image, corner.x, corner.y, width * view.scale, height * view.scale);
}

function drawScene(pen: Pen, scene: StageScene): void {
  drawCells(pen, scene);
  drawBoards(pen, scene);
  if (scene.axis !== null) drawAxis(pen, scene.axis);
  for (const arrow of scene.arrows) drawArrow(pen, arrow);
  if (scene.isUpsideDown && scene.seen !== null) drawRound(pen, scene.seen.centre);
  if (scene.dwell !== null && scene.wanted !== null) drawDwell(pen, scene.wanted.centre, scene.dwell);
}

function drawBoards(pen: Pen, { seen, wanted, isMatch, isUpsideDown }: StageScene): void {
  const seenColour = pen.colours(isMatch ? "guide-good" : "guide-seen");
  if (seen !== null) drawSeen(pen, seen, seenColour);
  if (wanted !== null)
    drawWanted(pen, wanted, pen.colours(isMatch ? "guide-good" : "guide-wanted"), isUpsideDown);
  if (seen !== null) drawFirstCell(pen, seen, seenColour, isUpsideDown);
}

function shapeOf(pen: Pen, points: readonly Point[]): Path2D {
  const path = new Path2D();
  points.forEach((point, i) => {
    const { x, y } = pen.at(point);
    if (i === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  });
  path.closePath();
  return path;
}

function stroke(pen: Pen, path: Path2D, width: number, colour: string): void {
  const { context, unit } = pen;
  context.lineJoin = "round";
  context.strokeStyle = pen.colours("mark-halo");
  context.globalAlpha = 0.65;
  context.lineWidth = (width + 3) * unit;
  context.stroke(path);
  context.globalAlpha = 1;
  context.strokeStyle = colour;
  context.lineWidth = width * unit;
  context.stroke(path);
}

function drawCells(pen: Pen, scene: StageScene): void {
  if (scene.cellsAlpha <= 0) return;
  pen.context.globalAlpha = 0.42 * scene.cellsAlpha;
  pen.context.fillStyle = pen.colours(scene.isMatch ? "guide-good" : "guide-wanted");
  for (const cell of scene.cells) pen.context.fill(shapeOf(pen, cell));
  pen.context.globalAlpha = 1;
}

function drawSeen(pen: Pen, seen: Outline, colour: string): void {
  stroke(pen, shapeOf(pen, seen.corners), 4, colour);
}

function drawWanted(pen: Pen, wanted: Outline, colour: string, isUrgent: boolean): void {
  pen.context.setLineDash([16 * pen.unit, 9 * pen.unit]);
  stroke(pen, shapeOf(pen, wanted.corners), 4, colour);
  pen.context.setLineDash([]);
  if (wanted.first === null) return;
  stroke(pen, circle(pen.at(wanted.first), (isUrgent ? 24 : 13) * pen.unit), isUrgent ? 6 : 4, colour);
}

function drawFirstCell(pen: Pen, seen: Outline, colour: string, isUrgent: boolean): void {
  if (seen.first === null) return;
  const dot = circle(pen.at(seen.first), (isUrgent ? 16 : 9) * pen.unit);
  stroke(pen, dot, 2, pen.colours("mark-halo"));
  pen.context.fillStyle = colour;
  pen.context.fill(dot);
}

function drawAxis(pen: Pen, axis: Arrow): void {
  pen.context.setLineDash([10 * pen.unit, 7 * pen.unit]);
  const line = new Path2D();
  const [from, to] = [pen.at(axis.from), pen.at(axis.to)];
  line.moveTo(from.x, from.y);
  line.lineTo(to.x, to.y);
  stroke(pen, line, 3, pen.colours("guide-move"));
  pen.context.setLineDash([]);
}

function drawArrow(pen: Pen, { from, to }: Arrow): void {
  const shape = arrowShape({ from: pen.at(from), to: pen.at(to) }, 9 * pen.unit);
  fillShape(pen, shape);
}

function fillShape(pen: Pen, shape: readonly Point[]): void {
  const { context } = pen;
  const path = shapeOf({ ...pen, at: (point) => point }, shape);
  context.lineJoin = "round";
  context.strokeStyle = pen.colours("mark-halo");
  context.lineWidth = 3 * pen.unit;
  context.stroke(path);
  context.fillStyle = pen.colours("guide-move");
  context.fill(path);
}

/** Two bent arrows that chase each other: turn the board half round, in the plane of the picture. */
function drawRound(pen: Pen, centre: Point): void {
  const { context, unit } = pen;
  const middle = pen.at(centre);
  const radius = 78 * unit;
  for (const start of [-0.35 * Math.PI, 0.65 * Math.PI]) {
    const end = start + 0.7 * Math.PI;
    const path = new Path2D();
    path.arc(middle.x, middle.y, radius, start, end);
    stroke(pen, path, 9, pen.colours("guide-move"));
    const tip = { x: middle.x + radius * Math.cos(end), y: middle.y + radius * Math.sin(end) };
    const ahead = { x: tip.x - 30 * unit * Math.sin(end), y: tip.y + 30 * unit * Math.cos(end) };
    fillShape(pen, arrowShape({ from: tip, to: ahead }, 9 * unit));
  }
  context.globalAlpha = 1;
}

function drawDwell(pen: Pen, centre: Point, share: number): void {
  const { context, unit } = pen;
  const { x, y } = pen.at(centre);
  const radius = 52 * unit;
  context.lineWidth = 17 * unit;
  context.globalAlpha = 0.55;
  context.strokeStyle = pen.colours("mark-halo");
  context.stroke(circle({ x, y }, radius));
  context.globalAlpha = 1;
  context.strokeStyle = pen.colours("guide-good");
  context.lineWidth = 13 * unit;
  context.beginPath();
  context.arc(x, y, radius, -0.5 * Math.PI, (2 * share - 0.5) * Math.PI);
  context.stroke();
}

function circle({ x, y }: Point, radius: number): Path2D {
  const path = new Path2D();
  path.arc(x, y, radius, 0, 2 * Math.PI);
  return path;
}
