// A target's pattern on a canvas, at any scale. All of it is one path: shapes that touch would show a seam else.
import type { TargetPattern } from "../generated/api";
import type { Point, Size } from "./viewport";

/** Where the board's origin lies on the canvas, and how many of its pixels a metre has. */
export interface Placement extends Point {
  perM: number;
}

type Extent = Pick<TargetPattern, "corner_m" | "size_m" | "quiet_m">;

/** Pixels that a pattern takes with the white that it needs around it. */
export function neededSize({ size_m, quiet_m }: Extent, perM: number): Size {
  return { width: (size_m[0] + 2 * quiet_m) * perM, height: (size_m[1] + 2 * quiet_m) * perM };
}

/** The share of its size in which a pattern fits on a canvas; its white border is kept. */
export function shareThatFits({ size_m, quiet_m }: Extent, canvas: Size, perM: number): number {
  const room = (size: number): number => size - 2 * quiet_m * perM;
  return Math.min(room(canvas.width) / (size_m[0] * perM), room(canvas.height) / (size_m[1] * perM));
}

/** The middle of the canvas, the origin on a whole pixel; null where the pattern is too large. */
export function placePattern(extent: Extent, canvas: Size, perM: number): Placement | null {
  const needed = neededSize(extent, perM);
  if (needed.width > canvas.width || needed.height > canvas.height) return null;
  const start = (room: number, size: number, corner: number): number =>
    Math.round((room - size * perM) / 2 - corner * perM);
  return {
    x: start(canvas.width, extent.size_m[0], extent.corner_m[0]),
    y: start(canvas.height, extent.size_m[1], extent.corner_m[1]),
    perM,
  };
}

export function drawPattern(
  context: CanvasRenderingContext2D,
  pattern: TargetPattern,
  { x, y, perM }: Placement,
  ink: string,
): void {
  const path = new Path2D();
  for (const loop of pattern.loops) {
    loop.forEach(([px, py], index) => {
      if (index === 0) path.moveTo(x + px * perM, y + py * perM);
      else path.lineTo(x + px * perM, y + py * perM);
    });
    path.closePath();
  }
  for (const [px, py, radius] of pattern.discs) {
    path.moveTo(x + (px + radius) * perM, y + py * perM);
    path.arc(x + px * perM, y + py * perM, radius * perM, 0, 2 * Math.PI);
  }
  context.fillStyle = ink;
  context.fill(path, "evenodd");
}
