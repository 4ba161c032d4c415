// A grid of values as a heat map in the camera's image, with its numbers, zones and scale. Pure but for the canvas.
import { cssOf, heatStops, inkOn, mixed, type Rgb } from "./colour_scale";
import type { Colours } from "./drawing";
import { centreOf, writtenCells, type Grid, type Zone } from "./heat_grid";
import { imageToCanvas } from "./image_frame";
import { toCanvasZone } from "./image_zones";
import type { Point, Size } from "./viewport";

export interface HeatScene {
  grid: Grid;
  imageSize: Size;
  /** Where the scale ends; larger values have its last colour. */
  end: number;
  /** How a value is written into the map. */
  write: (value: number) => string;
  workingZone?: Zone;
  validRegion?: Zone;
}

/** Room that a number in the map takes, canvas px. */
const NUMBER = { width: 74, height: 52 };
const HATCH = 7;

export function drawHeatMap(
  context: CanvasRenderingContext2D,
  size: Size,
  scene: HeatScene,
  colours: Colours,
): void {
  const at = imageToCanvas(scene.imageSize, size);
  const stops = heatStops(colours);
  const colourOf = (value: number): Rgb => mixed(stops, value / scene.end);
  drawCells(context, scene, at, colourOf, colours);
  if (scene.validRegion !== undefined) drawZone(context, toCanvasZone(scene.validRegion, at), [2, 4]);
  if (scene.workingZone !== undefined) drawZone(context, toCanvasZone(scene.workingZone, at), [9, 5]);
  drawNumbers(context, size, scene, at, colourOf);
}

function drawCells(
  context: CanvasRenderingContext2D,
  { grid, imageSize }: HeatScene,
  at: (point: Point) => Point,
  colourOf: (value: number) => Rgb,
  colours: Colours,
): void {
  const columns = grid[0]?.length ?? 1;
  const edge = (row: number, column: number): Point => {
    const { x, y } = at({
      x: (column * imageSize.width) / columns - 0.5,
      y: (row * imageSize.height) / grid.length - 0.5,
    });
    // On whole pixels there is no seam between cells.
    return { x: Math.round(x), y: Math.round(y) };
  };
  grid.forEach((values, row) =>
    values.forEach((value, column) => {
      const from = edge(row, column);
      const to = edge(row + 1, column + 1);
      if (value === null) hatch(context, from, to, colours);
      else {
        context.fillStyle = cssOf(colourOf(value));
        context.fillRect(from.x, from.y, to.x - from.x, to.y - from.y);
      }
    }),
  );
}

/** Where the lens does not reach there is no value, and no colour either. */
function hatch(context: CanvasRenderingContext2D, from: Point, to: Point, colours: Colours): void {
  context.save();
  context.beginPath();
  context.rect(from.x, from.y, to.x - from.x, to.y - from.y);
  context.fillStyle = colours("sunken");
  context.fill();
  context.clip();
  context.strokeStyle = colours("line-strong");
  context.lineWidth = 1;
  context.beginPath();
  // Lines of x + y = a multiple of the step go on from cell to cell.
  const first = Math.ceil((from.x + from.y) / HATCH) * HATCH;
  for (let sum = first; sum < to.x + to.y; sum += HATCH) {
    context.moveTo(sum - from.y, from.y);
    context.lineTo(sum - to.y, to.y);
  }
  context.stroke();
  context.restore();
}

function drawNumbers(
  context: CanvasRenderingContext2D,
  size: Size,
  { grid, imageSize, write }: HeatScene,
  at: (point: Point) => Point,
  colourOf: (value: number) => Rgb,
): void {
  context.font = `600 11.5px ${getComputedStyle(document.body).fontFamily}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  const across = Math.floor(size.width / NUMBER.width);
  for (const cell of writtenCells(grid, across, Math.floor(size.height / NUMBER.height))) {
    const value = grid[cell.row]?.[cell.column];
    if (value === null || value === undefined) continue;
    const { x, y } = at(centreOf(grid, imageSize, cell));
    const ground = colourOf(value);
    const text = write(value);
    const wide = context.measureText(text).width + 6;
    // Lines of zones do not run through numbers.
    context.fillStyle = cssOf(ground);
    context.fillRect(x - wide / 2, y - 8, wide, 15);
    context.fillStyle = inkOn(ground);
    context.fillText(text, x, y);
  }
}

/** White on black, dashed: seen on every colour of the scale. */
function drawZone(
  context: CanvasRenderingContext2D,
  { from, to }: { from: Point; to: Point },
  dash: number[],
): void {
  context.save();
  const sides = [from.x, from.y, to.x - from.x, to.y - from.y] as const;
  context.lineWidth = 3.5;
  context.strokeStyle = "rgb(0 0 0 / 65%)";
  context.strokeRect(...sides);
  context.setLineDash(dash);
  context.lineWidth = 1.75;
  context.strokeStyle = "#ffffff";
  context.strokeRect(...sides);
  context.restore();
}

export interface ScaleScene {
  ticks: readonly number[];
  write: (value: number) => string;
  /** Whether there are values beyond the end. */
  isExceeded: boolean;
}

const BAR = { height: 12, side: 26 };

export function drawScale(
  context: CanvasRenderingContext2D,
  size: Size,
  { ticks, write, isExceeded }: ScaleScene,
  colours: Colours,
): void {
  const stops = heatStops(colours);
  const end = ticks.at(-1) ?? 1;
  const width = size.width - 2 * BAR.side;
  for (let x = 0; x < width; x += 1) {
    context.fillStyle = cssOf(mixed(stops, x / Math.max(1, width - 1)));
    context.fillRect(BAR.side + x, 0, 1, BAR.height);
  }
  context.strokeStyle = colours("line-strong");
  context.strokeRect(BAR.side - 0.5, 0.5, width + 1, BAR.height - 1);
  context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const tick of ticks) {
    const x = BAR.side + (width * tick) / end;
    context.fillStyle = colours("plot-axis");
    context.fillRect(x - 0.5, BAR.height, 1, 4);
    context.fillStyle = colours("ink");
    const isLast = tick === end;
    context.fillText(isLast && isExceeded ? `≥ ${write(tick)}` : write(tick), x, BAR.height + 6);
  }
}
