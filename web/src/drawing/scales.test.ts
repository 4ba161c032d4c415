import { describe, expect, it } from "vitest";
import { digitsOfStep, median, roundStep, symmetricTicks } from "./scales";

describe("steps of an axis", () => {
  it.each([
    [10, 5, 2],
    [0.7, 6, 0.2],
    [1, 10, 0.1],
    [30, 4, 10],
  ])("of span %d with at most %d steps is %d", (span, most, step) => {
    expect(roundStep(span, most)).toBeCloseTo(step, 12);
  });

  it("are the same on both sides of zero", () => {
    const ticks = symmetricTicks(0.5, 6);
    expect(ticks).toHaveLength(5);
    expect(ticks[0]).toBeCloseTo(-0.4, 12);
    expect(ticks[2]).toBe(0);
    expect(ticks[4]).toBeCloseTo(0.4, 12);
  });

  it("are written with the digits they need", () => {
    expect([digitsOfStep(0.05), digitsOfStep(0.2), digitsOfStep(1), digitsOfStep(20)]).toEqual([2, 1, 0, 0]);
  });
});

describe("the median", () => {
  it("is the middle, or the mean of the two in the middle", () => {
    expect(median([3, 1, 2])).toBe(2);
    expect(median([4, 1, 2, 3])).toBe(2.5);
    expect(median([])).toBeNaN();
  });
});
