// Residuals of corners, detected minus reprojected, and what is said about many of them.
import type { Point } from "./viewport";

export interface CornerResidual {
  /** Where the corner was seen. */
  detected: Point;
  /** Where the calibration puts it. */
  reprojected: Point;
  du: number;
  dv: number;
  length: number;
}

type Pair = readonly number[];

export function cornerResiduals(
  detected: readonly Pair[],
  reprojected: readonly Pair[] | null,
): CornerResidual[] {
  if (reprojected === null) return [];
  return detected.flatMap((seen, i) => {
    const said = reprojected[i];
    if (said === undefined) return [];
    const from = pointOf(seen);
    const to = pointOf(said);
    const [du, dv] = [from.x - to.x, from.y - to.y];
    return [{ detected: from, reprojected: to, du, dv, length: Math.hypot(du, dv) }];
  });
}

export function pointOf(pair: Pair): Point {
  return { x: pair[0] ?? Number.NaN, y: pair[1] ?? Number.NaN };
}

/** Root of the mean squared length, px: the rms the service reports. */
export function rmsOf(residuals: readonly CornerResidual[]): number {
  if (residuals.length === 0) return Number.NaN;
  return Math.sqrt(residuals.reduce((sum, r) => sum + r.length ** 2, 0) / residuals.length);
}

/** Half width of a residual plot: shows every corner, and 4σ, but is not ruled by one far outlier. */
export function scatterLimit(residuals: readonly CornerResidual[], sigma: number): number {
  const largest = Math.max(0, ...residuals.map((r) => Math.max(Math.abs(r.du), Math.abs(r.dv))));
  return 1.08 * Math.min(Math.max(largest, 4 * sigma), 12 * sigma || largest || 1);
}

/** The end of a residual's arrow that starts at the reprojected corner; with gain 1 it ends at the detected one. */
export function arrowEnd(residual: CornerResidual, gain: number): Point {
  return {
    x: residual.reprojected.x + gain * residual.du,
    y: residual.reprojected.y + gain * residual.dv,
  };
}

/** Index of the point nearest to `at` within `reach`, or null. */
export function nearest(points: readonly Point[], at: Point, reach: number): number | null {
  let best: number | null = null;
  let closest = reach;
  points.forEach((point, i) => {
    const distance = Math.hypot(point.x - at.x, point.y - at.y);
    if (distance <= closest) [best, closest] = [i, distance];
  });
  return best;
}

export const GAINS = [1, 10, 20, 50, 100, 200, 500, 1000, 2000] as const;

/** The largest gain with which a typical arrow stays shorter than `length` image px. */
export function gainFor(rms: number, length: number): number {
  const fitting = GAINS.filter((gain) => gain * rms <= length);
  return fitting.at(-1) ?? 1;
}
