import { describe, expect, it } from "vitest";
import { filterFrom, queryOf, withCondition } from "./run_filter";

describe("filters of runs", () => {
  it("come back from an address as they were, and unknown names do not", () => {
    const filter = { serial: "VIN 1&2", sku: "lens1", verdict: "FAIL", since: "2026-03-01", first: "true" };
    expect(filterFrom(new URLSearchParams(`${queryOf(filter)}&colour=red`))).toEqual(filter);
  });

  it("have one order, whatever the order they were set in", () => {
    expect(queryOf({ verdict: "PASS", sku: "a" })).toBe(queryOf({ sku: "a", verdict: "PASS" }));
  });

  it("lose a condition whose value is empty", () => {
    expect(withCondition({ sku: "a", verdict: "FAIL" }, "verdict", "")).toEqual({ sku: "a" });
    expect(withCondition({}, "station", "cal1")).toEqual({ station: "cal1" });
    expect(queryOf({ sku: "" })).toBe("");
  });
});
