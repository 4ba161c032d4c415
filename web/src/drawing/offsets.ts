// Where another camera sees the same things, as arrows: enough of them to show a pattern, within a zone. Pure.
import { centreOf, type Grid, type Zone } from "./heat_grid";
import type { Point, Size } from "./viewport";

export interface Offset {
  from: Point;
  du: number;
  dv: number;
}

/** Of a grid every second cell gets an arrow. */
const EVERY = 2;

export function offsetsOf(u: Grid, v: Grid, image: Size, zone: Zone): Offset[] {
  return u.flatMap((values, row) =>
    values.flatMap((du, column) => {
      const dv = v[row]?.[column] ?? null;
      const from = centreOf(u, image, { row, column });
      const isShown = row % EVERY === 0 && column % EVERY === 0 && contains(zone, from);
      return isShown && du !== null && dv !== null ? [{ from, du, dv }] : [];
    }),
  );
}

function contains({ left_px, top_px, right_px, bottom_px }: Zone, { x, y }: Point): boolean {
  return x >= left_px && x <= right_px && y >= top_px && y <= bottom_px;
}
