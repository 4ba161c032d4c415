import { describe, expect, it } from "vitest";
import { cellAt, centreOf, largestOf, rangeWithin, scaleTicks, writtenCells, type Grid } from "./heat_grid";

const image = { width: 80, height: 40 };
const grid: Grid = [
  [9, 1, 2, null],
  [3, 4, 5, 6],
];

describe("cells of a grid over the image", () => {
  it("begin half a pixel before pixel 0", () => {
    expect(cellAt(grid, image, { x: -0.5, y: -0.5 })).toEqual({ row: 0, column: 0 });
    expect(cellAt(grid, image, { x: 19.4, y: 19.6 })).toEqual({ row: 1, column: 0 });
    expect(cellAt(grid, image, { x: 79.4, y: 39.4 })).toEqual({ row: 1, column: 3 });
    expect(cellAt(grid, image, { x: -0.6, y: 3 })).toBeNull();
    expect(cellAt(grid, image, { x: 3, y: 39.5 })).toBeNull();
  });

  it("hold their own centres", () => {
    grid.forEach((values, row) =>
      values.forEach((_, column) => {
        expect(cellAt(grid, image, centreOf(grid, image, { row, column }))).toEqual({ row, column });
      }),
    );
  });

  it("are looked at within a zone, without those that have no value", () => {
    const zone = { left_px: 20, top_px: 0, right_px: 79, bottom_px: 39 };
    expect(rangeWithin(grid, image, zone)).toEqual({ least: 1, largest: 6 });
    expect(largestOf(grid)).toBe(9);
    expect(rangeWithin(grid, image, { ...zone, left_px: 78 })).toEqual({ least: 0, largest: 0 });
  });

  it("have numbers written into them evenly, each cell once", () => {
    const large = Array.from({ length: 25 }, () => Array.from({ length: 40 }, () => 1));
    const cells = writtenCells(large, 8, 5);
    expect(cells).toHaveLength(40);
    expect(cells[0]).toEqual({ row: 2, column: 2 });
    expect(cells.at(-1)).toEqual({ row: 22, column: 37 });
    expect(writtenCells(grid, 8, 5)).toHaveLength(8);
    expect(writtenCells(grid, 0, 0)).toHaveLength(1);
  });
});

describe("the ticks of a scale", () => {
  it.each([
    [0.0983, [0, 0.02, 0.04, 0.06, 0.08, 0.1]],
    [9, [0, 2, 4, 6, 8, 10]],
    [1, [0, 0.2, 0.4, 0.6, 0.8, 1]],
    [0, [0, 1]],
  ])("are round and reach %d", (largest, ticks) => {
    const found = scaleTicks(largest);
    expect(found).toHaveLength(ticks.length);
    found.forEach((tick, i) => expect(tick).toBeCloseTo(ticks[i] ?? Number.NaN, 12));
  });
});
