import { describe, expect, it } from "vitest";
import { historyRange, type HistoryPoint } from "./history_points";

function point(value: number, sd: number | null): HistoryPoint {
  return { value, sd, verdict: "PASS", isHere: false };
}

describe("the range of a history", () => {
  it("holds all values with their bars, and air", () => {
    const [low, high] = historyRange([point(100, 1), point(104, 1)]);
    expect(low).toBeCloseTo(99 - 0.12 * 6);
    expect(high).toBeCloseTo(105 + 0.12 * 6);
  });

  it("is not ruled by the bar of a run that knows next to nothing", () => {
    const [low, high] = historyRange([point(100, 1), point(101, 1), point(102, 500)]);
    expect(high - low).toBeLessThan(10);
  });

  it("holds what is to be shown too", () => {
    const [low, high] = historyRange([point(0.04, null), point(0.06, null)], [0, 0.1]);
    expect(low).toBeCloseTo(-0.012);
    expect(high).toBeCloseTo(0.112);
  });

  it("has a span where there is one value without a bar", () => {
    const [low, high] = historyRange([point(1350, null)]);
    expect(low).toBeLessThan(1350);
    expect(high).toBeGreaterThan(1350);
  });
});
