import { describe, expect, it } from "vitest";
import {
  axisMarks,
  depthOf,
  orbited,
  pinholeRays,
  standpoint,
  toDrawing,
  VIEWS,
  viewAt,
  zoomed,
  type Vector,
} from "./space_geometry";

const distance = (a: Vector, b: Vector): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

describe("the drawing's frame", () => {
  it("is the camera's turned about x, so that nothing is mirrored", () => {
    const [x, y, z] = (
      [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ] as const
    ).map(toDrawing);
    const [a, b, c] = [x ?? [0, 0, 0], y ?? [0, 0, 0], z ?? [0, 0, 0]] as const;
    const determinant =
      a[0] * (b[1] * c[2] - b[2] * c[1]) -
      a[1] * (b[0] * c[2] - b[2] * c[0]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
    expect(determinant).toBe(1);
    expect(toDrawing([1, 2, 3])).toEqual([1, -2, -3]);
  });

  it("holds the view of a lens at any depth", () => {
    const rays = pinholeRays({ fx: 100, fy: 200, cx: 50, cy: 40 }, [101, 81]);
    expect(rays[0]).toEqual([-0.5, -0.2, 1]);
    expect(rays[2]).toEqual([0.5, 0.2, 1]);
    expect(viewAt(rays, 2)[0]).toEqual([-1, 0.4, -2]);
  });
});

describe("the viewer", () => {
  const at: Vector = [0.1, 0, -0.4];
  const from: Vector = [0.6, 0.5, 0.3];

  it("goes round at the same distance, and a round is a round", () => {
    let place: Vector = from;
    for (let step = 0; step < 36; step += 1) {
      place = orbited(place, at, Math.PI / 18, 0);
      expect(distance(place, at)).toBeCloseTo(distance(from, at), 9);
    }
    place.forEach((value, i) => expect(value).toBeCloseTo(from[i] ?? Number.NaN, 9));
  });

  it("goes to the right and up as told, but never over the top", () => {
    const front: Vector = [at[0], at[1], at[2] + 1];
    expect(orbited(front, at, 0.1, 0)[0]).toBeGreaterThan(front[0]);
    expect(orbited(front, at, 0, 0.1)[1]).toBeGreaterThan(front[1]);
    const top = orbited(front, at, 0, 10);
    expect(top[1]).toBeLessThan(at[1] + 1);
    expect(top[1]).toBeGreaterThan(at[1] + 0.99);
  });

  it("comes nearer along its line of sight", () => {
    expect(distance(zoomed(from, at, 0.5), at)).toBeCloseTo(distance(from, at) / 2, 12);
  });

  it.each(VIEWS)("stands apart from what it looks at: %s", (view) => {
    const { from: stand, at: seen } = standpoint(view, 0.8);
    expect(distance(stand, seen)).toBeGreaterThan(0.5);
  });
});

describe("distances", () => {
  it("reach to the farthest corner", () => {
    expect(
      depthOf([
        {
          corners: [
            [0, 0, 0.3],
            [0, 0, 0.7],
          ],
        },
        { corners: [[0, 0, 0.5]] },
      ]),
    ).toBe(0.7);
  });

  it.each([
    [0.8, [0.2, 0.4, 0.6, 0.8]],
    [0.3, [0.1, 0.2, 0.3]],
    [1, [0.25, 0.5, 0.75, 1]],
    [2.2, [0.5, 1, 1.5, 2]],
  ])("are written at round numbers up to %d", (depth, marks) => {
    const found = axisMarks(depth);
    expect(found).toHaveLength(marks.length);
    found.forEach((mark, i) => expect(mark).toBeCloseTo(marks[i] ?? Number.NaN, 9));
  });
});
