import { describe, expect, it } from "vitest";
import type { ReviewedPose } from "../generated/api";
import { judged, spreadOf, strongestPose } from "./review_sums";

const pose = (index: number, loss_share: number | null) => ({ index, loss_share }) as ReviewedPose;

describe("the pose that most rests on", () => {
  it("is the one whose loss is largest", () => {
    expect(strongestPose([pose(0, 0.1), pose(1, 0.3), pose(2, 0.2)])?.index).toBe(1);
  });

  it("is one that cannot be spared, where there is one", () => {
    expect(strongestPose([pose(0, 0.9), pose(1, null), pose(2, 0.2)])?.index).toBe(1);
    expect(strongestPose([])).toBeUndefined();
  });
});

it("a spread reaches from the least to the most", () => {
  expect(spreadOf([3, -7, 5])).toEqual({ least: -7, most: 5 });
});

it.each([
  [1, 0.9, true, "better"],
  [1, 1.1, true, "worse"],
  [0.5, 0.9, false, "better"],
  [1, 1.004, true, "same"],
  [1, 2, null, null],
  [null, 2, true, null],
] as const)("%d becomes %d, smaller better: %s: %s", (a, b, smallerIsBetter, word) => {
  expect(judged({ name: "norm", a, b, smallerIsBetter })).toBe(word);
});
