import { describe, expect, it } from "vitest";
import {
  bounded,
  dragMove,
  graspOf,
  joined,
  keyMove,
  NO_MOVE,
  pinchMove,
  unmirrored,
  wheelMove,
} from "./hand_moves";

const PLAIN = { button: 0, shiftKey: false, altKey: false };

describe("what a drag does", () => {
  it("is what was chosen, unless button or key says otherwise", () => {
    expect(graspOf(PLAIN, "shift")).toBe("shift");
    expect(graspOf(PLAIN, "roll")).toBe("roll");
    expect(graspOf({ ...PLAIN, button: 2 }, "shift")).toBe("tilt");
    expect(graspOf({ ...PLAIN, shiftKey: true }, "shift")).toBe("tilt");
    expect(graspOf({ ...PLAIN, altKey: true }, "shift")).toBe("roll");
  });

  it("carries the board with the pointer at every size of the picture", () => {
    expect(dragMove("shift", { x: 30, y: -10 }, 0.5)).toEqual({ right_px: 60, down_px: -20 });
  });

  it("tilts the board as a ball under the pointer: down brings the top edge, right the left edge", () => {
    const { tilt_deg = 0, turn_deg = 0 } = dragMove("tilt", { x: 40, y: 20 }, 1);
    expect(tilt_deg).toBeGreaterThan(0);
    expect(turn_deg).toBeLessThan(0);
  });
});

describe("wheel, fingers and keys", () => {
  it("comes closer when the wheel turns up, by lines as by px, and never at once", () => {
    expect(wheelMove({ deltaY: -100, deltaMode: 0 }).closer_share).toBeCloseTo(0.05);
    expect(wheelMove({ deltaY: 3, deltaMode: 1 }).closer_share).toBeCloseTo(-0.0495);
    expect(wheelMove({ deltaY: -1e6, deltaMode: 0 }).closer_share).toBe(0.25);
  });

  it("spreads, carries and turns with two fingers, also through half a turn", () => {
    const move = pinchMove(
      [
        { x: 0, y: 0 },
        { x: 100, y: 0 },
      ],
      [
        { x: 60, y: -100 },
        { x: 60, y: 100 },
      ],
      1,
    );
    expect(move.right_px).toBeCloseTo(10);
    expect(move.closer_share).toBeCloseTo(1);
    expect(move.roll_deg).toBeCloseTo(90);
    const across = pinchMove(
      [
        { x: 100, y: 1 },
        { x: 0, y: 0 },
      ],
      [
        { x: 100, y: -1 },
        { x: 0, y: 0 },
      ],
      1,
    );
    expect(Math.abs(across.roll_deg ?? 90)).toBeLessThan(2);
  });

  it("moves by keys, and leaves other keys alone", () => {
    expect(keyMove("ArrowLeft", false)).toEqual({ right_px: -8 });
    expect(keyMove("ArrowUp", true)).toEqual({ tilt_deg: -2 });
    expect(keyMove("E", true)).toEqual({ roll_deg: 2 });
    expect(keyMove("+", true)).toEqual({ closer_share: 0.02 });
    expect(keyMove("x", false)).toBeNull();
    expect(keyMove("Enter", false)).toBeNull();
  });
});

describe("moves together", () => {
  it("swaps left and right in a mirrored picture, and nothing else", () => {
    const move = { right_px: 5, down_px: 2, turn_deg: 3, tilt_deg: 4, roll_deg: 6, closer_share: 0.1 };
    expect(unmirrored(move, false)).toEqual(move);
    expect(unmirrored(move, true)).toEqual({ ...move, right_px: -5, turn_deg: -3, roll_deg: -6 });
  });

  it("never says more than the service takes", () => {
    const far = { ...NO_MOVE, closer_share: 9, tilt_deg: -500, right_px: 3 };
    expect(bounded(far)).toEqual({ ...NO_MOVE, closer_share: 1, tilt_deg: -90, right_px: 3 });
  });

  it("adds up", () => {
    const twice = joined(joined(NO_MOVE, { closer_share: 0.1, right_px: 2 }), {
      closer_share: 0.1,
      right_px: 1,
    });
    expect(twice.closer_share).toBeCloseTo(0.21);
    expect(twice.right_px).toBe(3);
  });
});
