import { describe, expect, it } from "vitest";
import { halfSize, packRows } from "./half_size";

describe("half size", () => {
  it("is the rounded mean of each 2x2", () => {
    const grey = Uint8Array.of(0, 1, 10, 20, 2, 3, 30, 41);

    expect([...halfSize(grey, 4, 2)]).toEqual([2, 25]);
  });

  it("leaves out an odd last row and column", () => {
    expect([...halfSize(Uint8Array.of(4, 4, 9, 4, 4, 9, 9, 9, 9), 3, 3)]).toEqual([4]);
  });

  it("does not overflow where everything is white", () => {
    expect([...halfSize(new Uint8Array(4).fill(255), 2, 2)]).toEqual([255]);
  });
});

describe("rows of a frame", () => {
  it("lose their padding", () => {
    const bytes = Uint8Array.of(99, 1, 2, 0, 0, 3, 4, 0, 0);

    expect([...packRows(bytes, { offset: 1, stride: 4, step: 1 }, 2, 2)]).toEqual([1, 2, 3, 4]);
  });

  it("give one channel of four", () => {
    const rgba = Uint8Array.of(1, 50, 3, 255, 4, 60, 6, 255);

    expect([...packRows(rgba, { offset: 1, stride: 8, step: 4 }, 2, 1)]).toEqual([50, 60]);
  });
});
