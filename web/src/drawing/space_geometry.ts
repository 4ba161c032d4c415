// Where things are in the drawing of poses in space. The camera's frame is x right, y down, z forward; the drawing's
// is x right, y up, z towards the viewer: half a turn about x, so nothing is mirrored.

export type Vector = readonly [number, number, number];

export interface SpaceBoard {
  /** tl, tr, br, bl in the board's own order, camera frame, m. */
  corners: readonly Vector[];
}

export interface SpaceScene {
  boards: readonly SpaceBoard[];
  /** Squares of the printed pattern. */
  squares: { columns: number; rows: number };
  /** Rays of the image's corners, tl, tr, br, bl, at depth 1. */
  cornerRays: readonly Vector[];
}

export function toDrawing([x, y, z]: Vector): Vector {
  return [x, 0 - y, 0 - z];
}

/** How far from the camera the farthest corner is, along its axis. */
export function depthOf(boards: readonly SpaceBoard[]): number {
  return boards.reduce(
    (deepest, { corners }) => corners.reduce((most, [, , z]) => Math.max(most, z), deepest),
    0.1,
  );
}

/** Corners of the view at a depth, in the drawing. */
export function viewAt(rays: readonly Vector[], depth: number): Vector[] {
  return rays.map(([x, y, z]) => toDrawing([x * depth, y * depth, z * depth]));
}

/** Rays of a lens without distortion, where the real ones are not known. */
export function pinholeRays(
  nominal: Record<string, number>,
  [width, height]: readonly [number, number],
): Vector[] {
  const { fx = width, fy = width, cx = width / 2, cy = height / 2 } = nominal;
  const ray = (u: number, v: number): Vector => [(u - cx) / fx, (v - cy) / fy, 1];
  return [ray(0, 0), ray(width - 1, 0), ray(width - 1, height - 1), ray(0, height - 1)];
}

export const VIEWS = ["oblique", "camera", "side", "above"] as const;
export type View = (typeof VIEWS)[number];

/** Where the viewer stands and looks at, for boards up to a depth, as multiples of it. */
export function standpoint(view: View, depth: number): { from: Vector; at: Vector } {
  const at: Vector = [0, 0, -0.55 * depth];
  const scaled = ([x, y, z]: Vector): Vector => [x * depth, y * depth, z * depth];
  switch (view) {
    case "oblique":
      return { from: scaled([0.7, 0.5, 0.42]), at };
    case "camera":
      // A little behind the camera, so that its own frame is seen.
      return { from: scaled([0, 0, 0.35]), at };
    case "side":
      return { from: scaled([1.45, 0.02, -0.5]), at };
    case "above":
      // Not straight from above: then up would have no direction.
      return { from: scaled([0, 1.5, -0.5]), at };
  }
}

const SMALLEST_POLAR = 0.05;

/** Goes round a point by angles, rad, at the same distance: to the right, and up. */
export function orbited(from: Vector, at: Vector, right: number, up: number): Vector {
  const [x, y, z] = [from[0] - at[0], from[1] - at[1], from[2] - at[2]];
  const distance = Math.hypot(x, y, z);
  const azimuth = Math.atan2(x, z) + right;
  const polar = Math.min(
    Math.PI - SMALLEST_POLAR,
    Math.max(SMALLEST_POLAR, Math.acos(Math.min(1, Math.max(-1, y / distance))) - up),
  );
  const flat = distance * Math.sin(polar);
  return [
    at[0] + flat * Math.sin(azimuth),
    at[1] + distance * Math.cos(polar),
    at[2] + flat * Math.cos(azimuth),
  ];
}

/** Nearer by a factor below 1, farther by one above. */
export function zoomed(from: Vector, at: Vector, factor: number): Vector {
  return [
    at[0] + (from[0] - at[0]) * factor,
    at[1] + (from[1] - at[1]) * factor,
    at[2] + (from[2] - at[2]) * factor,
  ];
}

/** Round distances on the optical axis to write: at most four. */
export function axisMarks(depth: number): number[] {
  const step = [0.05, 0.1, 0.2, 0.25, 0.5, 1, 2, 5].find((one) => depth / one <= 4.5) ?? 10;
  return Array.from({ length: Math.floor(depth / step + 1e-9) }, (_, i) => (i + 1) * step);
}
