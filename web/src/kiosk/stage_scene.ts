// From what the service says about a frame to what is drawn over it. Pure; the drawing itself is in stage_drawing.
import type { Run, State } from "../generated/protocol";
import type { Point } from "../drawing/viewport";
import { centreOf, cornerArrows, distance, keystoneArrows, turningAxis, type Arrow } from "./arrows";
import { cellsOf, firstCell } from "./board_cells";
import type { HintCode } from "./mirror";

export interface StageScene {
  wanted: Outline | null;
  seen: Outline | null;
  /** What is filled of the wanted board, and how strongly it shows: it fades as the board comes near. */
  cells: Point[][];
  cellsAlpha: number;
  arrows: Arrow[];
  axis: Arrow | null;
  /** The board must be turned round: its first corner matters more than anything. */
  isUpsideDown: boolean;
  /** Within every tolerance: everything is drawn as good. */
  isMatch: boolean;
  /** Share of the dwell that has passed; null: no ring. */
  dwell: number | null;
}

export interface Outline {
  corners: Point[];
  /** Middle of the square at corner 0, or the first dot: it tells the board's two orientations apart. */
  first: Point | null;
  centre: Point;
}

type Pair = [number, number];

/** Corner distance, as a share of the board's diagonal, at which cells are gone, and from which they are full. */
const CELLS_GONE = 0.05;
const CELLS_FULL = 0.35;
const KEYSTONE_SHARE = 0.1;

function point([x, y]: Pair): Point {
  return { x, y };
}

export function sceneOf(run: Pick<Run, "board" | "image_size">, live: State): StageScene {
  const { ghost, seen: found, hints } = live;
  const wanted = ghost === null ? null : outline(ghost.outline, ghost.corners, run.board);
  const seen = found === null ? null : outline(found.outline, found.corners, run.board);
  const code = hints[0]?.code;
  return {
    wanted,
    seen,
    cells: ghost === null ? [] : cellsOf(ghost.corners.map(point), run.board),
    cellsAlpha: wanted === null ? 0 : cellsAlpha(wanted, seen),
    ...wayOf(code, seen, wanted, KEYSTONE_SHARE * run.image_size[1]),
    isUpsideDown: code === "turn-upside-down",
    ...arrivalOf(live),
  };
}

function wayOf(
  code: HintCode | undefined,
  seen: Outline | null,
  wanted: Outline | null,
  keystone_px: number,
): Pick<StageScene, "arrows" | "axis"> {
  if (code === undefined || seen === null || wanted === null) return { arrows: [], axis: null };
  const arrows = [
    ...cornerArrows(code, seen.corners, wanted.corners),
    ...keystoneArrows(code, seen.corners, keystone_px),
  ];
  return { arrows, axis: turningAxis(code, seen.corners) };
}

function arrivalOf(live: State): Pick<StageScene, "isMatch" | "dwell"> {
  if (live.is_capturing) return { isMatch: true, dwell: 1 };
  if (live.dwell > 0) return { isMatch: true, dwell: live.dwell };
  return { isMatch: live.match >= 1 && live.board === "present", dwell: null };
}

function outline(outer: readonly Pair[], corners: readonly Pair[], board: Run["board"]): Outline {
  const points = outer.map(point);
  const first = firstCell(corners.map(point), board);
  return { corners: points, first, centre: centreOf(points) };
}

function cellsAlpha(wanted: Outline, seen: Outline | null): number {
  if (seen === null) return 1;
  const [first, , third] = wanted.corners;
  if (first === undefined || third === undefined) return 0;
  const away = wanted.corners.map((corner, i) => distance(corner, seen.corners[i] ?? corner));
  const share = away.reduce((a, b) => a + b, 0) / away.length / distance(first, third);
  return Math.min(1, Math.max(0, (share - CELLS_GONE) / (CELLS_FULL - CELLS_GONE)));
}
