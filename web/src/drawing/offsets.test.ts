import { describe, expect, it } from "vitest";
import { offsetsOf } from "./offsets";

const IMAGE = { width: 40, height: 40 };
const WHOLE = { left_px: 0, top_px: 0, right_px: 39, bottom_px: 39 };
const GRID = Array.from({ length: 4 }, (_, row) => Array.from({ length: 4 }, (_, column) => row + column));

describe("offsets as arrows", () => {
  it("are those of every second cell, at its centre", () => {
    const found = offsetsOf(GRID, GRID, IMAGE, WHOLE);
    expect(found).toHaveLength(4);
    expect(found[3]).toEqual({ from: { x: 24.5, y: 24.5 }, du: 4, dv: 4 });
  });

  it("are left out beyond the zone and where a lens does not reach", () => {
    const holed = GRID.map((values, row) => values.map((value) => (row === 0 ? null : value)));
    expect(offsetsOf(holed, GRID, IMAGE, WHOLE)).toHaveLength(2);
    expect(offsetsOf(GRID, holed, IMAGE, { ...WHOLE, right_px: 20 })).toHaveLength(1);
  });
});
