import { describe, expect, it } from "vitest";
import { apart, columnsOf, powerTicks, rangeOf, type Curve } from "./count_curve";

const point = (poses: number, mean: number | null) => ({
  poses,
  norm_px: 10 / poses,
  mapping_mean_px: mean,
  mapping_worst_px: mean === null ? null : 2 * mean,
});
const one: Curve = { name: "A", points: [point(3, 0.4), point(5, 0.2)], own: 5, smallest: null };
const two: Curve = { name: "B", points: [point(4, null), point(5, 0.1)], own: 4, smallest: 5 };

describe("columns of the chart", () => {
  it("stand over all counts of both curves, with gaps where a curve has none", () => {
    expect(columnsOf([one, two])).toEqual([
      [3, 4, 5],
      [0.4, null, 0.2],
      [0.8, null, 0.4],
      [10 / 3, null, 2],
      [null, null, 0.1],
      [null, null, 0.2],
      [null, 2.5, 2],
    ]);
  });
});

describe("the axis of powers", () => {
  it("holds every value and the required one", () => {
    const [low, high] = rangeOf([0.2, null, 3], 0.05);
    expect(low).toBeLessThan(0.05);
    expect(high).toBeGreaterThan(3);
    expect(rangeOf([null], null)).toEqual([0.01, 1]);
  });

  it("has ticks at 1, 2 and 5", () => {
    const found = powerTicks(0.045, 1.2);
    [0.05, 0.1, 0.2, 0.5, 1].forEach((tick, i) => expect(found[i]).toBeCloseTo(tick, 12));
    expect(found).toHaveLength(5);
  });
});

it("labels are moved apart and keep their order", () => {
  expect(apart([10, 50, 12, 14], 14)).toEqual([10, 52, 24, 38]);
  expect(apart([5, 30], 14)).toEqual([5, 30]);
});
