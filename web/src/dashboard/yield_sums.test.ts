import { describe, expect, it } from "vitest";
import type { YieldCount } from "../generated/api";
import { daysBetween, firstPassYield, runsOf, sumOf, sumsBy } from "./yield_sums";

function count(sku: string, day: string, first_passed: number): YieldCount {
  return { sku, station: null, day, passed: 3, marginal: 1, failed: 2, first_runs: 5, first_passed };
}

const COUNTS = [count("b", "2026-03-01", 4), count("a", "2026-03-01", 5), count("b", "2026-03-02", 3)];

describe("sums of counts", () => {
  it("are of everything, and of nothing zero", () => {
    expect(sumOf(COUNTS)).toEqual({ passed: 9, marginal: 3, failed: 6, firstRuns: 15, firstPassed: 12 });
    expect(runsOf(sumOf(COUNTS))).toBe(18);
    expect(runsOf(sumOf([]))).toBe(0);
  });

  it("are of each key, in the order of the counts", () => {
    const sums = sumsBy(COUNTS, ({ sku }) => sku);
    expect(sums.map(({ key }) => key)).toEqual(["b", "a"]);
    expect(sums.map((one) => firstPassYield(one.sums))).toEqual([0.7, 1]);
  });

  it("have no yield without a first run, and none of 0 %", () => {
    expect(firstPassYield(sumOf([]))).toBeNull();
  });
});

it("days are all named, over the end of a month and the change to summer time", () => {
  expect(daysBetween("2026-02-27", "2026-03-02")).toEqual([
    "2026-02-27",
    "2026-02-28",
    "2026-03-01",
    "2026-03-02",
  ]);
  expect(daysBetween("2026-03-20", "2026-04-18")).toHaveLength(30);
});
