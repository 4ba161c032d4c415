import { describe, expect, it } from "vitest";
import { cellsOf, firstCell } from "./board_cells";

const CIRCLES = { columns: 3, rows: 4, dot_steps: 0.5 };
const STEP = 10;

/** Dots of a grid that faces the camera, the first one at a place. */
function grid(left: number, top: number) {
  return Array.from({ length: 12 }, (_, i) => {
    const row = Math.floor(i / 3);
    return { x: left + (2 * (i % 3) + (row % 2)) * STEP, y: top + row * STEP };
  });
}

describe("a grid of circles", () => {
  it("is filled by its dots, each around its place and of its size", () => {
    const corners = grid(100, 50);
    const cells = cellsOf(corners, CIRCLES);

    expect(cells).toHaveLength(12);
    cells.forEach((rim, i) => {
      for (const point of rim) {
        const away = Math.hypot(point.x - (corners[i]?.x ?? 0), point.y - (corners[i]?.y ?? 0));
        expect(away).toBeCloseTo(2.5, 9);
      }
    });
  });

  it("is foreshortened as its grid is", () => {
    const flat = grid(0, 0).map(({ x, y }) => ({ x, y: 0.5 * y }));
    const rim = cellsOf(flat, CIRCLES)[4] ?? [];

    expect(Math.max(...rim.map(({ x }) => x)) - Math.min(...rim.map(({ x }) => x))).toBeCloseTo(5, 6);
    expect(Math.max(...rim.map(({ y }) => y)) - Math.min(...rim.map(({ y }) => y))).toBeCloseTo(2.5, 6);
  });

  it("is told which way up it is by its first dot", () => {
    expect(firstCell(grid(7, 9), CIRCLES)).toEqual({ x: 7, y: 9 });
  });
});
