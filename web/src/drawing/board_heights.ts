// Heights of a board's corners as a grid over the board: a cell for each corner where corners form a grid. Pure.
import type { Grid } from "./heat_grid";
import type { Size } from "./viewport";

/** A corner: where the pattern has it, and how far it is from there, mm; z points away from who looks. */
export interface ShapedCorner {
  x: number;
  y: number;
  z: number;
}

export interface BoardHeights {
  /** Height, µm, towards who looks, above the lowest corner. */
  grid: Grid;
  /** By cell the index of its nearest corner. */
  corners: readonly (readonly number[])[];
  /** What the grid covers, mm. */
  size: Size;
}

/** More cells than this are too small to tell anything. */
const MOST_CELLS = 60;
const NEIGHBOURS = 4;
/** Corners that are nearer to each other along an axis than this share of the board are in line. */
const IN_LINE = 1e-4;

export function heightsAbove(corners: readonly ShapedCorner[]): number[] {
  const lowest = Math.max(...corners.map(({ z }) => z));
  return corners.map(({ z }) => 1000 * (lowest - z));
}

export function boardHeights(corners: readonly ShapedCorner[]): BoardHeights {
  const heights = heightsAbove(corners);
  const across = cellsOf(corners.map(({ x }) => x));
  const down = cellsOf(corners.map(({ y }) => y));
  const near = down.centres.map((y) => across.centres.map((x) => nearest(corners, x, y)));
  return {
    grid: near.map((row) => row.map((found) => between(found, heights))),
    corners: near.map((row) => row.map((found) => found[0]?.index ?? 0)),
    size: {
      width: across.step * across.centres.length,
      height: down.step * down.centres.length,
    },
  };
}

/** Cells along one axis, as wide as the least distance of corners. */
function cellsOf(places: readonly number[]): { centres: number[]; step: number } {
  const sorted = [...places].sort((a, b) => a - b);
  const first = sorted[0] ?? 0;
  const length = (sorted.at(-1) ?? 0) - first;
  const gaps = sorted
    .map((place, i) => place - (sorted[i - 1] ?? place))
    .filter((gap) => gap > IN_LINE * length);
  if (gaps.length === 0) return { centres: [first], step: 1 };
  const steps = Math.min(MOST_CELLS - 1, Math.round(length / Math.min(...gaps)));
  const step = length / steps;
  return { centres: Array.from({ length: steps + 1 }, (_, i) => first + i * step), step };
}

interface Neighbour {
  index: number;
  distance: number;
}

function nearest(corners: readonly ShapedCorner[], x: number, y: number): Neighbour[] {
  return corners
    .map((corner, index) => ({ index, distance: Math.hypot(corner.x - x, corner.y - y) }))
    .sort((a, b) => a.distance - b.distance)
    .slice(0, NEIGHBOURS);
}

/** A corner's own height where the cell is the corner's, else the mean of those around it, near ones most. */
function between(found: readonly Neighbour[], heights: readonly number[]): number {
  const [first, second] = found;
  if (first === undefined) return 0;
  if (second === undefined || first.distance < 1e-3 * second.distance) return heights[first.index] ?? 0;
  const weights = found.map(({ distance }) => 1 / distance ** 2);
  const sum = weights.reduce((all, weight) => all + weight, 0);
  return found.reduce((all, { index }, i) => all + ((weights[i] ?? 0) * (heights[index] ?? 0)) / sum, 0);
}
