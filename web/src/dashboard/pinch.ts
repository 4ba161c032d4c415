// What fingers on an image mean: one moves it, two zoom and move it.
import type { Point } from "../drawing/viewport";

export interface Gesture {
  /** By how much the image grows, and about which point. */
  factor: number;
  at: Point;
  by: Point;
}

/** From where the fingers were to where they are; fingers beyond two do nothing. */
export function gestureOf(before: readonly Point[], after: readonly Point[]): Gesture | null {
  const [a, b] = before;
  const [c, d] = after;
  if (a === undefined || c === undefined || before.length !== after.length) return null;
  if (b === undefined || d === undefined) return { factor: 1, at: c, by: difference(c, a) };
  if (before.length > 2) return null;
  const apart = Math.hypot(b.x - a.x, b.y - a.y);
  const factor = apart > 0 ? Math.hypot(d.x - c.x, d.y - c.y) / apart : 1;
  const [from, to] = [middle(a, b), middle(c, d)];
  return { factor, at: to, by: difference(to, from) };
}

function middle(a: Point, b: Point): Point {
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}

function difference(a: Point, b: Point): Point {
  return { x: a.x - b.x, y: a.y - b.y };
}
