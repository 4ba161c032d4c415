// A board seen from the side (tilt) or from above (turn): how it is held, how it is wanted, which way it turns.
// In px of a 160 x 120 drawing; the camera is left of the board, or below it.
import type { PoseAngles, State } from "../generated/protocol";
import type { Point } from "../drawing/viewport";
import type { HintCode } from "./mirror";

export interface SideView {
  view: "side" | "top";
  present: [Point, Point];
  wanted: [Point, Point];
  /** From the present to the wanted place of the edge that the words name. */
  bend: { from: Point; to: Point; isClockwise: boolean };
}

const SIDE_CENTRE: Point = { x: 104, y: 60 };
const TOP_CENTRE: Point = { x: 80, y: 46 };
const HALF_BOARD = 43;
const ARROW_RADIUS = HALF_BOARD + 6;
/** Smaller ways are drawn so large, larger ones so small, that the arrow can be read. */
const LEAST_DEG = 24;
const MOST_DEG = 60;
const STEEPEST_DEG = 62;

interface Way {
  view: "side" | "top";
  sign: 1 | -1;
  edge: 0 | 1;
}

/** `sign`: 1 where the top (from the side) or the left edge (from above) goes away from the camera. */
const WAYS: Partial<Record<HintCode, Way>> = {
  "tilt-top-back": { view: "side", sign: 1, edge: 0 },
  "tilt-top-forward": { view: "side", sign: -1, edge: 0 },
  "turn-left-back": { view: "top", sign: 1, edge: 0 },
  "turn-right-back": { view: "top", sign: -1, edge: 1 },
};

/** Null for instructions that are no tilt or turn. `code` is the one on the display, which may be mirrored. */
export function sideView(
  code: HintCode,
  wanted: PoseAngles | null,
  difference: State["difference"],
  isMirrored: boolean,
): SideView | null {
  const way = WAYS[code];
  if (way === undefined) return null;
  const isSide = way.view === "side";
  const way_deg = Math.abs((isSide ? difference?.tilt_deg : difference?.turn_deg) ?? LEAST_DEG);
  const shown_deg = way.sign * Math.min(MOST_DEG, Math.max(LEAST_DEG, way_deg));
  const target_deg = clamp(wanted === null ? 0 : awayAngle(wanted, isSide, isMirrored), STEEPEST_DEG);
  const present_deg = clamp(target_deg - shown_deg, 85);
  const place = isSide ? fromTheSide : fromAbove;
  const radius = ARROW_RADIUS;
  return {
    view: way.view,
    present: [place(present_deg, 0, HALF_BOARD), place(present_deg, 1, HALF_BOARD)],
    wanted: [place(target_deg, 0, HALF_BOARD), place(target_deg, 1, HALF_BOARD)],
    bend: {
      from: place(present_deg, way.edge, radius),
      to: place(target_deg, way.edge, radius),
      // The top going away turns clockwise when seen from the left; the left edge does when seen from above.
      isClockwise: way.sign === 1,
    },
  };
}

/** How far the top, or the left edge on the display, is tilted away from the camera, deg. */
function awayAngle(angles: PoseAngles, isSide: boolean, isMirrored: boolean): number {
  if (isSide) return -angles.tilt_deg;
  return isMirrored ? -angles.turn_deg : angles.turn_deg;
}

function clamp(value: number, most: number): number {
  return Math.min(most, Math.max(-most, value));
}

/** `edge` 0 is the top. */
function fromTheSide(away_deg: number, edge: 0 | 1, radius: number): Point {
  const angle = (away_deg * Math.PI) / 180;
  const side = edge === 0 ? 1 : -1;
  return {
    x: SIDE_CENTRE.x + side * radius * Math.sin(angle),
    y: SIDE_CENTRE.y - side * radius * Math.cos(angle),
  };
}

/** `edge` 0 is the left one. */
function fromAbove(away_deg: number, edge: 0 | 1, radius: number): Point {
  const angle = (away_deg * Math.PI) / 180;
  const side = edge === 0 ? 1 : -1;
  return {
    x: TOP_CENTRE.x - side * radius * Math.cos(angle),
    y: TOP_CENTRE.y - side * radius * Math.sin(angle),
  };
}
