// The predicted error against the number of poses: data of the chart, its axis, and what is marked in it. Pure.
import type { PredictedCount } from "../generated/api";

export interface Curve {
  name: string;
  points: readonly PredictedCount[];
  /** How many poses the set itself has. */
  own: number;
  smallest: number | null;
}

export const QUANTITIES = ["mapping_mean_px", "mapping_worst_px", "norm_px"] as const;
export type Quantity = (typeof QUANTITIES)[number];

/** Columns for uPlot: the counts, then for each curve its three quantities; null where a curve has no such count. */
export function columnsOf(curves: readonly Curve[]): [number[], ...(number | null)[][]] {
  const counts = [...new Set(curves.flatMap(({ points }) => points.map(({ poses }) => poses)))].sort(
    (a, b) => a - b,
  );
  const columns = curves.flatMap(({ points }) => {
    const byCount = new Map(points.map((point) => [point.poses, point]));
    return QUANTITIES.map((quantity) => counts.map((count) => positive(byCount.get(count)?.[quantity])));
  });
  return [counts, ...columns];
}

/** An axis of powers has no place for zero. */
function positive(value: number | null | undefined): number | null {
  return value !== null && value !== undefined && value > 0 ? value : null;
}

/** The range of an axis of powers that holds all values and a line, with air around them. */
export function rangeOf(values: readonly (number | null)[], line: number | null): [number, number] {
  const known = [...values, line].filter((value): value is number => value !== null && value > 0);
  if (known.length === 0) return [0.01, 1];
  return [Math.min(...known) / 1.35, Math.max(...known) * 1.35];
}

/** 1, 2 and 5 times powers of ten within a range. */
export function powerTicks(low: number, high: number): number[] {
  const first = Math.floor(Math.log10(low));
  const last = Math.ceil(Math.log10(high));
  return Array.from({ length: last - first + 1 }, (_, i) => first + i)
    .flatMap((power) => [1, 2, 5].map((factor) => factor * 10 ** power))
    .filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

export function pointAt(curve: Curve, count: number): PredictedCount | undefined {
  return curve.points.find(({ poses }) => poses === count);
}

/** Moves labels of line ends apart; places from top to bottom keep their order. */
export function apart(places: readonly number[], distance: number): number[] {
  const order = places.map((place, i) => ({ place, i })).sort((a, b) => a.place - b.place);
  const moved = [...places];
  let last = Number.NEGATIVE_INFINITY;
  for (const { place, i } of order) {
    last = Math.max(place, last + distance);
    moved[i] = last;
  }
  return moved;
}
