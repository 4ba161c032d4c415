import { describe, expect, it } from "vitest";
import { barEnd, LIMIT_AT, usedShare } from "./margin";

describe("the share of a limit that is used", () => {
  it("is 1 at the limit, for upper and lower limits", () => {
    expect(usedShare(0.35, 0.35, "<=")).toBe(1);
    expect(usedShare(40, 40, ">=")).toBe(1);
  });

  it("is small where there is much room, and beyond 1 where the limit is missed", () => {
    expect(usedShare(0.07, 0.35, "<=")).toBeCloseTo(0.2, 12);
    expect(usedShare(160, 40, ">=")).toBeCloseTo(0.25, 12);
    expect(usedShare(20, 40, ">=")).toBe(2);
    expect(usedShare(0, 40, ">=")).toBe(Number.POSITIVE_INFINITY);
  });

  it("is none where there is nothing to compare", () => {
    expect(usedShare(null, 1, "<=")).toBeNull();
    expect(usedShare(1, null, "<=")).toBeNull();
    expect(usedShare(1, 1, "==")).toBeNull();
    expect(usedShare(0, 0, "<=")).toBeNull();
  });
});

describe("the bar", () => {
  it("ends at the tick when the value is at its limit, and never leaves its frame", () => {
    expect(barEnd(1)).toBe(LIMIT_AT);
    expect(barEnd(Number.POSITIVE_INFINITY)).toBe(1);
    expect(barEnd(0)).toBe(0);
  });
});
