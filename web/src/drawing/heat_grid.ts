// A grid of values over the image: its range, its cells, the numbers that a scale and a map write.
import { roundStep } from "./scales";
import type { Point, Size } from "./viewport";

/** Values row by row from the top left; null where there is none. */
export type Grid = readonly (readonly (number | null)[])[];

export interface Zone {
  left_px: number;
  top_px: number;
  right_px: number;
  bottom_px: number;
}

export interface Cell {
  row: number;
  column: number;
}

/** Pixel 0's centre is 0, so the image begins at −0.5. */
export function cellAt(grid: Grid, image: Size, at: Point): Cell | null {
  const rows = grid.length;
  const columns = grid[0]?.length ?? 0;
  const row = Math.floor(((at.y + 0.5) * rows) / image.height);
  const column = Math.floor(((at.x + 0.5) * columns) / image.width);
  return row >= 0 && row < rows && column >= 0 && column < columns ? { row, column } : null;
}

export function centreOf(grid: Grid, image: Size, { row, column }: Cell): Point {
  const columns = grid[0]?.length ?? 1;
  return {
    x: ((column + 0.5) * image.width) / columns - 0.5,
    y: ((row + 0.5) * image.height) / grid.length - 0.5,
  };
}

/** The least and the largest value of cells whose centres lie in a zone; zeros where there are none. */
export function rangeWithin(grid: Grid, image: Size, zone: Zone): { least: number; largest: number } {
  const found = grid.flatMap((values, row) =>
    values.filter((value, column): value is number => {
      const { x, y } = centreOf(grid, image, { row, column });
      const isInside = x >= zone.left_px && x <= zone.right_px && y >= zone.top_px && y <= zone.bottom_px;
      return isInside && value !== null;
    }),
  );
  if (found.length === 0) return { least: 0, largest: 0 };
  return { least: Math.min(...found), largest: Math.max(...found) };
}

export function largestOf(grid: Grid): number {
  return grid.reduce(
    (most, values) => values.reduce<number>((best, value) => Math.max(best, value ?? 0), most),
    0,
  );
}

const MOST_STEPS = 5;

/** Round numbers of a scale from 0 to at least `largest`; the last one is where the scale ends. */
export function scaleTicks(largest: number, most = MOST_STEPS): number[] {
  const step = largest > 0 ? roundStep(largest, most) : 1;
  const count = Math.max(1, Math.ceil(largest / step - 1e-9));
  return Array.from({ length: count + 1 }, (_, i) => i * step);
}

/** Cells whose value is written into the map: every so many, so that each has room. */
export function writtenCells(grid: Grid, across: number, down: number): Cell[] {
  const rows = spaced(grid.length, down);
  const columns = spaced(grid[0]?.length ?? 0, across);
  return rows.flatMap((row) => columns.map((column) => ({ row, column })));
}

function spaced(length: number, count: number): number[] {
  const shown = Math.max(1, Math.min(count, length));
  return Array.from({ length: shown }, (_, i) => Math.floor(((i + 0.5) * length) / shown));
}
