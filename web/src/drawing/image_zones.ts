// Zones of the camera's image in a drawing.
import type { Colours } from "./drawing";
import type { Zone } from "./heat_grid";
import type { Point } from "./viewport";

export function toCanvasZone(zone: Zone, at: (point: Point) => Point): { from: Point; to: Point } {
  return { from: at({ x: zone.left_px, y: zone.top_px }), to: at({ x: zone.right_px, y: zone.bottom_px }) };
}

export function drawZoneLine(
  context: CanvasRenderingContext2D,
  zone: Zone,
  at: (point: Point) => Point,
  colours: Colours,
): void {
  const { from, to } = toCanvasZone(zone, at);
  context.save();
  context.strokeStyle = colours("plot-ring");
  context.lineWidth = 1.5;
  context.setLineDash([9, 5]);
  context.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
  context.restore();
}
