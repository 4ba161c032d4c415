// The outlines of a pose set's boards in the image: centres, and which one a pointer means.
import type { Point } from "./viewport";

export interface Outline {
  /** Place in the order of the set, from 1. */
  number: number;
  /** Along the outline, from the board's first corner on, image px. */
  corners: readonly Point[];
  centre: Point;
}

export function outlinesOf(poses: readonly { outer_corners: readonly (readonly number[])[] }[]): Outline[] {
  return boundOutlines(poses.map(({ outer_corners }) => outer_corners));
}

/** Outlines of closed lines, which may bend with the lens; each begins at the board's first corner. */
export function boundOutlines(lines: readonly (readonly (readonly number[])[])[]): Outline[] {
  return lines.map((line, i) => {
    const corners = line.map(([x, y]) => ({ x: x ?? Number.NaN, y: y ?? Number.NaN }));
    return { number: i + 1, corners, centre: centreOf(corners) };
  });
}

function centreOf(corners: readonly Point[]): Point {
  const count = Math.max(1, corners.length);
  return {
    x: corners.reduce((sum, corner) => sum + corner.x, 0) / count,
    y: corners.reduce((sum, corner) => sum + corner.y, 0) / count,
  };
}

/** Index of the outline that holds a point of the image; of several the one whose centre is nearest; else null. */
export function outlineAt(outlines: readonly Outline[], at: Point): number | null {
  let best: number | null = null;
  let closest = Number.POSITIVE_INFINITY;
  outlines.forEach((outline, i) => {
    const distance = Math.hypot(outline.centre.x - at.x, outline.centre.y - at.y);
    if (distance < closest && holds(outline.corners, at)) [best, closest] = [i, distance];
  });
  return best;
}

/** A ray from the point to the right crosses the outline an odd number of times. */
function holds(corners: readonly Point[], at: Point): boolean {
  let inside = false;
  corners.forEach((from, i) => {
    const to = corners[(i + 1) % corners.length] ?? from;
    if (from.y > at.y === to.y > at.y) return;
    if (at.x < from.x + ((at.y - from.y) * (to.x - from.x)) / (to.y - from.y)) inside = !inside;
  });
  return inside;
}

const MOST_ROUNDS = 40;

/** Moves labels apart that would cover each other: places in canvas px, all with the same radius. */
export function spread(places: readonly Point[], radius: number): Point[] {
  const moved = places.map((place) => ({ ...place }));
  for (let round = 0; round < MOST_ROUNDS; round += 1) {
    if (!partOnce(moved, 2 * radius + 1)) break;
  }
  return moved;
}

/** Pushes apart every two that are nearer than `apart`, each by half; says whether there were any. */
function partOnce(places: Point[], apart: number): boolean {
  let moved = false;
  places.forEach((one, i) => {
    for (const other of places.slice(i + 1)) {
      const [dx, dy] = [other.x - one.x, other.y - one.y];
      const distance = Math.hypot(dx, dy);
      if (distance >= apart) continue;
      moved = true;
      // Two at one place part sideways; the order keeps the result the same every time.
      const [ux, uy] = distance < 1e-6 ? [1, 0] : [dx / distance, dy / distance];
      const push = (apart - distance) / 2;
      one.x -= ux * push;
      one.y -= uy * push;
      other.x += ux * push;
      other.y += uy * push;
    }
  });
  return moved;
}
