import { describe, expect, it } from "vitest";
import { boardHeights, heightsAbove, type ShapedCorner } from "./board_heights";

/** A board of 4 × 3 corners, 20 mm apart, row by row; corner 5 stands 0.3 mm out, corner 0 lies 0.1 mm back. */
const chessboard: ShapedCorner[] = Array.from({ length: 12 }, (_, i) => ({
  x: 20 * (i % 4),
  y: 20 * Math.floor(i / 4),
  z: i === 5 ? -0.3 : i === 0 ? 0.1 : 0,
}));

describe("heights of a board", () => {
  it("count from its lowest corner towards who looks, in µm", () => {
    const heights = heightsAbove(chessboard);
    expect(heights[0]).toBeCloseTo(0);
    expect(heights[5]).toBeCloseTo(400);
    expect(heights[11]).toBeCloseTo(100);
  });

  it("have a cell for each corner of a grid, in its row and column", () => {
    const { grid, corners, size } = boardHeights(chessboard);
    expect(grid.map((row) => row.length)).toEqual([4, 4, 4]);
    expect(size).toEqual({ width: 80, height: 60 });
    expect(grid[1]?.[1]).toBeCloseTo(400);
    expect(grid[0]?.[0]).toBeCloseTo(0);
    expect(corners).toEqual([
      [0, 1, 2, 3],
      [4, 5, 6, 7],
      [8, 9, 10, 11],
    ]);
  });

  it("lie between those of its neighbours where no corner is, as between staggered discs", () => {
    const staggered = chessboard.map(({ x, y, z }) => ({
      x: x + ((y / 20) % 2) * 10,
      y,
      z: z < 0 ? -0.3 : 0,
    }));
    const { grid } = boardHeights(staggered);
    expect(grid.map((row) => row.length)).toEqual([8, 8, 8]);
    const row = grid[1] ?? [];
    // Corner 5 is at x = 30 of the second row: its own height there, less beside it, and no more than it.
    expect(row[3]).toBeCloseTo(300);
    expect(row[2]).toBeGreaterThan(10);
    expect(row[2]).toBeLessThan(290);
    expect(row[7]).toBeCloseTo(0);
  });

  it("are those of a single row too", () => {
    const { grid, size } = boardHeights(chessboard.slice(0, 4));
    expect(grid).toHaveLength(1);
    expect(size.height).toBe(1);
  });
});
