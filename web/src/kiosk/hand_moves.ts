// From what a person does on the picture to how the virtual board moves. Pure; directions out are the raw image's.
import type { MoveBoard } from "../generated/protocol";
import type { Point } from "../drawing/viewport";

export type Move = Required<Omit<MoveBoard, "type">>;
export type Grasp = "shift" | "tilt" | "roll";

export const NO_MOVE: Move = {
  right_px: 0,
  down_px: 0,
  closer_share: 0,
  tilt_deg: 0,
  turn_deg: 0,
  roll_deg: 0,
};

const DEG_PER_PX = 0.25;
const SHARE_PER_WHEEL_PX = 0.0005;
const LARGEST_WHEEL = 0.25;
const PX_PER_LINE = 33;
const STEP_PX = 8;
const STEP_DEG = 2;
const STEP_SHARE = 0.02;

export interface Held {
  button: number;
  shiftKey: boolean;
  altKey: boolean;
}

/** What a drag does: the right button or Shift tilts, Alt rolls, else what was chosen. */
export function graspOf({ button, shiftKey, altKey }: Held, chosen: Grasp): Grasp {
  if (altKey) return "roll";
  return button === 2 || shiftKey ? "tilt" : chosen;
}

/** `by`: css px; `scale`: css px per px of the image. A tilt goes as if the board were a ball under the pointer. */
export function dragMove(grasp: Grasp, by: Point, scale: number): Partial<Move> {
  switch (grasp) {
    case "shift":
      return { right_px: by.x / scale, down_px: by.y / scale };
    case "tilt":
      return { tilt_deg: by.y * DEG_PER_PX, turn_deg: -by.x * DEG_PER_PX };
    case "roll":
      return { roll_deg: by.x * DEG_PER_PX };
  }
}

/** Upwards is closer. */
export function wheelMove({ deltaY, deltaMode }: Pick<WheelEvent, "deltaY" | "deltaMode">): Partial<Move> {
  const px = deltaMode === 0 ? deltaY : deltaY * PX_PER_LINE;
  return { closer_share: Math.min(LARGEST_WHEEL, Math.max(-LARGEST_WHEEL, -px * SHARE_PER_WHEEL_PX)) };
}

/** Two fingers, before and after: they carry the board, spread it closer and turn it in the picture. */
export function pinchMove(
  before: readonly [Point, Point],
  after: readonly [Point, Point],
  scale: number,
): Partial<Move> {
  const [a, b] = [spanOf(before), spanOf(after)];
  const turned = ((b.angle - a.angle + 3 * Math.PI) % (2 * Math.PI)) - Math.PI;
  return {
    right_px: (b.x - a.x) / scale,
    down_px: (b.y - a.y) / scale,
    closer_share: Math.min(1, Math.max(-0.5, b.length / a.length - 1)),
    roll_deg: (180 * turned) / Math.PI,
  };
}

function spanOf([p, q]: readonly [Point, Point]): { x: number; y: number; length: number; angle: number } {
  const [dx, dy] = [q.x - p.x, q.y - p.y];
  return {
    x: (p.x + q.x) / 2,
    y: (p.y + q.y) / 2,
    length: Math.max(1, Math.hypot(dx, dy)),
    angle: Math.atan2(dy, dx),
  };
}

/** As far as one message may move the board. */
const MOST: Readonly<Record<keyof Move, readonly [number, number]>> = {
  right_px: [-10_000, 10_000],
  down_px: [-10_000, 10_000],
  closer_share: [-0.5, 1],
  tilt_deg: [-90, 90],
  turn_deg: [-90, 90],
  roll_deg: [-180, 180],
};

export function bounded(move: Move): Move {
  const within = (name: keyof Move): number => Math.min(MOST[name][1], Math.max(MOST[name][0], move[name]));
  return {
    right_px: within("right_px"),
    down_px: within("down_px"),
    closer_share: within("closer_share"),
    tilt_deg: within("tilt_deg"),
    turn_deg: within("turn_deg"),
    roll_deg: within("roll_deg"),
  };
}

const KEYS: Readonly<Record<string, Partial<Move>>> = {
  ArrowLeft: { right_px: -STEP_PX },
  ArrowRight: { right_px: STEP_PX },
  ArrowUp: { down_px: -STEP_PX },
  ArrowDown: { down_px: STEP_PX },
  q: { roll_deg: -STEP_DEG },
  e: { roll_deg: STEP_DEG },
  "+": { closer_share: STEP_SHARE },
  "-": { closer_share: -STEP_SHARE },
};
const KEYS_WITH_SHIFT: Readonly<Record<string, Partial<Move>>> = {
  ArrowLeft: { turn_deg: STEP_DEG },
  ArrowRight: { turn_deg: -STEP_DEG },
  ArrowUp: { tilt_deg: -STEP_DEG },
  ArrowDown: { tilt_deg: STEP_DEG },
};

/** Null for keys that move nothing. */
export function keyMove(key: string, isShifted: boolean): Partial<Move> | null {
  const name = key.length === 1 ? key.toLowerCase() : key;
  return (isShifted ? KEYS_WITH_SHIFT[name] : undefined) ?? KEYS[name] ?? null;
}

/** The move as the raw image has it, where the picture is shown mirrored. */
export function unmirrored(move: Partial<Move>, isMirrored: boolean): Partial<Move> {
  if (!isMirrored) return move;
  const { right_px = 0, turn_deg = 0, roll_deg = 0 } = move;
  return { ...move, right_px: -right_px, turn_deg: -turn_deg, roll_deg: -roll_deg };
}

export function joined(first: Move, second: Partial<Move>): Move {
  const move = { ...NO_MOVE, ...second };
  return {
    right_px: first.right_px + move.right_px,
    down_px: first.down_px + move.down_px,
    closer_share: (1 + first.closer_share) * (1 + move.closer_share) - 1,
    tilt_deg: first.tilt_deg + move.tilt_deg,
    turn_deg: first.turn_deg + move.turn_deg,
    roll_deg: first.roll_deg + move.roll_deg,
  };
}
