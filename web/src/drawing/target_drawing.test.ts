import { describe, expect, it } from "vitest";
import { neededSize, placePattern, shareThatFits } from "./target_drawing";

const BOARD = {
  corner_m: [-0.025, -0.025] as [number, number],
  size_m: [0.25, 0.175] as [number, number],
  quiet_m: 0.004,
};

describe("a pattern on a canvas", () => {
  it("lies in the middle, its origin on a whole pixel", () => {
    const place = placePattern(BOARD, { width: 1281, height: 800 }, 4000);

    expect(place).toEqual({ x: 241, y: 150, perM: 4000 });
  });

  it("needs white around it", () => {
    const needed = neededSize(BOARD, 4000);

    expect(needed.width).toBeCloseTo(1032, 9);
    expect(needed.height).toBeCloseTo(732, 9);
    expect(placePattern(BOARD, { width: 1031, height: 800 }, 4000)).toBeNull();
    expect(placePattern(BOARD, { width: 1280, height: 731 }, 4000)).toBeNull();
  });

  it("fits in a share of its size, with that white as wide as before", () => {
    expect(shareThatFits(BOARD, { width: 1032, height: 2000 }, 4000)).toBeCloseTo(1, 9);
    expect(shareThatFits(BOARD, { width: 532, height: 2000 }, 4000)).toBeCloseTo(0.5, 9);
    expect(shareThatFits(BOARD, { width: 532, height: 172 }, 4000)).toBeCloseTo(0.2, 9);
    expect(shareThatFits(BOARD, { width: 10, height: 10 }, 4000)).toBeLessThan(0);
  });
});
