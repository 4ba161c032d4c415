import { expect, it } from "vitest";
import { boardTiltDeg, distanceM } from "./view_pose";

it("a board turned about the camera's axis is not tilted", () => {
  expect(boardTiltDeg([0, 0, 1.2])).toBeCloseTo(0, 6);
  expect(boardTiltDeg([0, 0, 0])).toBe(0);
});

it("a board turned about an edge is tilted by that angle", () => {
  expect(boardTiltDeg([Math.PI / 6, 0, 0])).toBeCloseTo(30, 9);
  expect(boardTiltDeg([0, -Math.PI / 4, 0])).toBeCloseTo(45, 9);
});

it("the tilt of a mixed turn is the angle of R33", () => {
  // R33 = cos(angle) + (1 - cos(angle)) * nz², with axis (1, 1, 1)/√3 and 120° the axes swap and R33 = 0.
  const part = (2 * Math.PI) / 3 / Math.sqrt(3);
  expect(boardTiltDeg([part, part, part])).toBeCloseTo(90, 6);
});

it("the distance is the length of the translation", () => {
  expect(distanceM([0.3, 0, 0.4])).toBeCloseTo(0.5, 12);
});
