import { describe, expect, it } from "vitest";
import type { PastCalibration } from "../generated/api";
import { previousOf, quantityOf } from "./history_quantities";

const RUNS = ["one", "two", "three"].map(
  (run_id) =>
    ({ run_id, rms_px: 0.1, intrinsics: { fx: 1350 }, sd: { fx: 0.2 } }) as unknown as PastCalibration,
);

describe("a history", () => {
  it("has a value with its sd for a parameter, and the rms without one", () => {
    expect(RUNS.map((run) => quantityOf(run, "fx"))[0]).toEqual({ value: 1350, sd: 0.2 });
    expect(RUNS.map((run) => quantityOf(run, "rms"))[0]).toEqual({ value: 0.1, sd: null });
  });

  it("knows the run before another one", () => {
    expect(previousOf(RUNS, "three")).toBe("two");
    expect(previousOf(RUNS, "one")).toBeNull();
    expect(previousOf(RUNS, "not finished")).toBeNull();
  });
});
