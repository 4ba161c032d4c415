// Where the arrows over the picture begin and end, in image px. Pure geometry, tested without a canvas.
import type { Point } from "../drawing/viewport";
import type { HintCode } from "./mirror";

export interface Arrow {
  from: Point;
  to: Point;
}

/** Instructions whose way the corners of the board show best. */
const CORNERWISE: ReadonlySet<HintCode> = new Set([
  "move-left",
  "move-right",
  "move-up",
  "move-down",
  "move-closer",
  "move-away",
  "rotate-clockwise",
  "rotate-counterclockwise",
]);
const SHORTEST_PX = 12;

export function centreOf(points: readonly Point[]): Point {
  const sum = points.reduce((a, b) => ({ x: a.x + b.x, y: a.y + b.y }), { x: 0, y: 0 });
  return { x: sum.x / points.length, y: sum.y / points.length };
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(b.x - a.x, b.y - a.y);
}

/** From each corner that is seen to where it is wanted; arrows too short to be read are left out. */
export function cornerArrows(code: HintCode, seen: readonly Point[], wanted: readonly Point[]): Arrow[] {
  if (!CORNERWISE.has(code)) return [];
  return seen.flatMap((from, i) => {
    const to = wanted[i];
    return to === undefined || distance(from, to) < SHORTEST_PX ? [] : [{ from, to }];
  });
}

interface Keystone {
  /** Which way the edges run along which the outline grows or shrinks. */
  along: "x" | "y";
  /** Whether corners on the side with the smaller coordinate (top, left) move outwards. */
  firstGrows: boolean;
}

const KEYSTONES: Partial<Record<HintCode, Keystone>> = {
  "tilt-top-forward": { along: "x", firstGrows: true },
  "tilt-top-back": { along: "x", firstGrows: false },
  "turn-right-back": { along: "y", firstGrows: true },
  "turn-left-back": { along: "y", firstGrows: false },
};

/**
 * How the outline changes when a board is tilted or turned, exaggerated: the edge that comes nearer grows. The
 * true way of the corners is too short to be seen.
 */
export function keystoneArrows(code: HintCode, seen: readonly Point[], length: number): Arrow[] {
  const keystone = KEYSTONES[code];
  if (keystone === undefined) return [];
  const { along, firstGrows } = keystone;
  const across = along === "x" ? "y" : "x";
  const centre = centreOf(seen);
  return seen.map((corner) => {
    const outwards = corner[along] < centre[along] ? -length : length;
    const outside = { ...corner, [along]: corner[along] + outwards };
    const isFirst = corner[across] < centre[across];
    return isFirst === firstGrows ? { from: corner, to: outside } : { from: outside, to: corner };
  });
}

/** The axis about which a board is to be tilted or turned, a little longer than the board. */
export function turningAxis(code: HintCode, seen: readonly Point[]): Arrow | null {
  const keystone = KEYSTONES[code];
  if (keystone === undefined) return null;
  const centre = centreOf(seen);
  const half =
    1.15 * Math.max(...seen.map((corner) => Math.abs(corner[keystone.along] - centre[keystone.along])));
  return {
    from: { ...centre, [keystone.along]: centre[keystone.along] - half },
    to: { ...centre, [keystone.along]: centre[keystone.along] + half },
  };
}

/** The outline of an arrow with a head, as a polygon. */
export function arrowShape({ from, to }: Arrow, width: number): Point[] {
  const length = distance(from, to);
  if (length === 0) return [];
  const x = (to.x - from.x) / length;
  const y = (to.y - from.y) / length;
  const head = Math.min(3.2 * width, length);
  const at = (along: number, aside: number): Point => ({
    x: from.x + along * x - aside * y,
    y: from.y + along * y + aside * x,
  });
  const neck = length - head;
  const thin = width / 2;
  const wide = 1.45 * width;
  return [
    at(0, thin),
    at(neck, thin),
    at(neck, wide),
    at(length, 0),
    at(neck, -wide),
    at(neck, -thin),
    at(0, -thin),
  ];
}
