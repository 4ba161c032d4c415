import { describe, expect, it } from "vitest";
import { gestureOf } from "./pinch";

const at = (x: number, y: number): { x: number; y: number } => ({ x, y });

describe("fingers on an image", () => {
  it("move it when there is one", () => {
    expect(gestureOf([at(10, 10)], [at(15, 8)])).toEqual({ factor: 1, at: at(15, 8), by: at(5, -2) });
  });

  it("zoom it about their middle when there are two, and take it along", () => {
    expect(gestureOf([at(0, 0), at(10, 0)], [at(0, 4), at(20, 4)])).toEqual({
      factor: 2,
      at: at(10, 4),
      by: at(5, 4),
    });
  });

  it("do nothing when one comes or goes, when there are three, and not without a distance", () => {
    expect(gestureOf([at(0, 0)], [at(0, 0), at(9, 9)])).toBeNull();
    const three = [at(0, 0), at(1, 1), at(2, 2)];
    expect(gestureOf(three, three)).toBeNull();
    expect(gestureOf([at(1, 1), at(1, 1)], [at(1, 1), at(5, 5)])?.factor).toBe(1);
  });
});
