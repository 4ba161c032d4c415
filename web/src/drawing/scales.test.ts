import { describe, expect, it } from "vitest";
import { LIMIT_AT, marginBar } from "./margin";
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

describe("the bar of a margin", () => {
  it("ends at the limit's tick when the value is at its limit", () => {
    expect(marginBar(0.35, 0.35, "<=")).toEqual({ value: LIMIT_AT, share: 1, good: "left" });
    expect(marginBar(40, 40, ">=")).toEqual({ value: LIMIT_AT, share: 1, good: "right" });
  });

  it("does not leave its frame", () => {
    expect(marginBar(1000, 1, "<=")?.value).toBe(1);
    expect(marginBar(-3, 1, "<=")?.value).toBe(0);
  });

  it("is not drawn where there is nothing to compare", () => {
    expect(marginBar(null, 1, "<=")).toBeNull();
    expect(marginBar(1, null, "<=")).toBeNull();
    expect(marginBar(1, 1, "==")).toBeNull();
    expect(marginBar(0, 0, "<=")).toBeNull();
  });
});
