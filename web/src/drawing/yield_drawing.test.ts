import { expect, it } from "vitest";
import { lowestShare } from "./yield_drawing";

const day = (firstPass: number | null) => ({ label: "", passed: 1, marginal: 0, failed: 0, firstPass });

it.each([
  [[1, 0.97], 0.8],
  [[0.95, 0.85], 0.8],
  [[0.8], 0.7],
  [[0.31, 1], 0.3],
  [[0], 0],
  [[null], 0.8],
])("the axis of a yield of %j begins at %d", (shares, low) => {
  expect(lowestShare(shares.map(day))).toBeCloseTo(low, 9);
});
