import { describe, expect, it } from "vitest";
import { arrowEnd, cornerResiduals, gainFor, nearest, rmsOf, scatterLimit } from "./residuals";

const residuals = cornerResiduals(
  [
    [10, 20],
    [30, 40],
  ],
  [
    [9.7, 20.4],
    [30, 40],
  ],
);

describe("residuals of corners", () => {
  it("are detected minus reprojected", () => {
    expect(residuals[0]?.du).toBeCloseTo(0.3, 9);
    expect(residuals[0]?.dv).toBeCloseTo(-0.4, 9);
    expect(residuals[0]?.length).toBeCloseTo(0.5, 9);
  });

  it("do not exist before the solve", () => {
    expect(cornerResiduals([[1, 2]], null)).toEqual([]);
  });

  it("have the rms the service reports: over corners, not over coordinates", () => {
    expect(rmsOf(residuals)).toBeCloseTo(Math.sqrt(0.25 / 2), 9);
    expect(rmsOf([])).toBeNaN();
  });
});

describe("arrows of residuals", () => {
  it("end at the detected corner when they are not enlarged", () => {
    const end = arrowEnd(residuals[0] ?? expect.fail(), 1);
    expect(end.x).toBeCloseTo(10, 9);
    expect(end.y).toBeCloseTo(20, 9);
  });

  it("point from the reprojected towards the detected corner, times the gain", () => {
    const end = arrowEnd(residuals[0] ?? expect.fail(), 100);
    expect(end.x).toBeCloseTo(9.7 + 30, 9);
    expect(end.y).toBeCloseTo(20.4 - 40, 9);
  });

  it("take the largest gain that keeps them short", () => {
    expect(gainFor(0.16, 32)).toBe(200);
    expect(gainFor(40, 32)).toBe(1);
    expect(gainFor(Number.NaN, 32)).toBe(1);
  });
});

describe("the limit of the scatter", () => {
  it("shows 4σ even when all residuals are small", () => {
    expect(scatterLimit(residuals, 0.5)).toBeCloseTo(1.08 * 2, 9);
  });

  it("is not ruled by one far outlier", () => {
    const far = cornerResiduals([[100, 0]], [[0, 0]]);
    expect(scatterLimit(far, 0.1)).toBeCloseTo(1.08 * 1.2, 9);
  });
});

describe("the nearest corner", () => {
  const points = [
    { x: 0, y: 0 },
    { x: 10, y: 0 },
  ];
  it("is the closer one, within reach", () => {
    expect(nearest(points, { x: 7, y: 0 }, 5)).toBe(1);
    expect(nearest(points, { x: 50, y: 0 }, 5)).toBeNull();
  });
});
