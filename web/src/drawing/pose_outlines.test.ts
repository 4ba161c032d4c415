import { describe, expect, it } from "vitest";
import { outlineAt, outlinesOf, spread } from "./pose_outlines";

function square(x: number, y: number, half: number): { outer_corners: [number, number][] } {
  return {
    outer_corners: [
      [x - half, y - half],
      [x + half, y - half],
      [x + half, y + half],
      [x - half, y + half],
    ],
  };
}

describe("outlines of poses", () => {
  const outlines = outlinesOf([square(100, 100, 50), square(140, 100, 50)]);

  it("are numbered from 1 and have their centres", () => {
    expect(outlines.map(({ number, centre }) => [number, centre])).toEqual([
      [1, { x: 100, y: 100 }],
      [2, { x: 140, y: 100 }],
    ]);
  });

  it("are picked by the pointer, the nearer one where two overlap", () => {
    expect(outlineAt(outlines, { x: 55, y: 100 })).toBe(0);
    expect(outlineAt(outlines, { x: 125, y: 100 })).toBe(1);
    expect(outlineAt(outlines, { x: 115, y: 100 })).toBe(0);
    expect(outlineAt(outlines, { x: 300, y: 100 })).toBeNull();
    expect(outlineAt(outlines, { x: 120, y: 151 })).toBeNull();
  });
});

describe("labels", () => {
  it("stay where they are when there is room", () => {
    const places = [
      { x: 0, y: 0 },
      { x: 30, y: 0 },
    ];
    expect(spread(places, 10)).toEqual(places);
  });

  it("part until none covers another, even from one place", () => {
    const moved = spread(
      [...Array(5).keys()].map((i) => ({ x: 100 + i, y: 100 - (i % 2) })),
      10,
    );
    for (const [i, one] of moved.entries()) {
      for (const other of moved.slice(i + 1)) {
        expect(Math.hypot(one.x - other.x, one.y - other.y)).toBeGreaterThan(19);
      }
    }
  });
});
