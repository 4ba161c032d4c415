import { describe, expect, it } from "vitest";
import { arrowShape, centreOf, cornerArrows, keystoneArrows, turningAxis } from "./arrows";

const SEEN = [
  { x: 100, y: 100 },
  { x: 300, y: 100 },
  { x: 300, y: 200 },
  { x: 100, y: 200 },
];

describe("arrows from corner to corner", () => {
  const wanted = SEEN.map(({ x, y }) => ({ x: x + 50, y }));

  it("lead every corner to its place", () => {
    const arrows = cornerArrows("move-right", SEEN, wanted);

    expect(arrows).toHaveLength(4);
    expect(arrows[0]).toEqual({ from: { x: 100, y: 100 }, to: { x: 150, y: 100 } });
  });

  it("are left out where they say nothing: for tilts, and when the board is there", () => {
    expect(cornerArrows("tilt-top-back", SEEN, wanted)).toEqual([]);
    expect(cornerArrows("move-right", SEEN, SEEN)).toEqual([]);
  });
});

describe("arrows of a tilt", () => {
  it("pull the top edge apart when it comes to the camera, and press the bottom edge together", () => {
    const [topLeft, topRight, bottomRight] = keystoneArrows("tilt-top-forward", SEEN, 40);

    expect(topLeft).toEqual({ from: { x: 100, y: 100 }, to: { x: 60, y: 100 } });
    expect(topRight?.to.x).toBe(340);
    expect(bottomRight).toEqual({ from: { x: 340, y: 200 }, to: { x: 300, y: 200 } });
  });

  it("are the other way round when the top goes back", () => {
    const forward = keystoneArrows("tilt-top-forward", SEEN, 40);
    const back = keystoneArrows("tilt-top-back", SEEN, 40);

    expect(back).toEqual(forward.map(({ from, to }) => ({ from: to, to: from })));
  });

  it("press the left edge together when it goes back", () => {
    const [topLeft, topRight] = keystoneArrows("turn-left-back", SEEN, 40);

    expect(topLeft).toEqual({ from: { x: 100, y: 60 }, to: { x: 100, y: 100 } });
    expect(topRight).toEqual({ from: { x: 300, y: 100 }, to: { x: 300, y: 60 } });
  });

  it("do not depend on how the board is turned in the image: the upper corners are the top", () => {
    const turned = [...SEEN.slice(2), ...SEEN.slice(0, 2)];
    const tops = keystoneArrows("tilt-top-forward", turned, 40).filter(({ from }) => from.y === 100);

    expect(tops.map(({ to }) => to.x).sort((a, b) => a - b)).toEqual([60, 340]);
  });

  it("stand about an axis through the board's middle", () => {
    const axis = turningAxis("tilt-top-back", SEEN);

    expect([axis?.from.y, axis?.to.y]).toEqual([150, 150]);
    expect(axis?.from.x).toBeCloseTo(85, 9);
    expect(axis?.to.x).toBeCloseTo(315, 9);
    expect(turningAxis("move-up", SEEN)).toBeNull();
  });
});

it("an arrow ends in its tip", () => {
  const shape = arrowShape({ from: { x: 0, y: 0 }, to: { x: 100, y: 0 } }, 10);

  expect(shape[3]).toEqual({ x: 100, y: 0 });
  expect(Math.max(...shape.map(({ x }) => x))).toBe(100);
  expect(centreOf(shape).y).toBeCloseTo(0, 9);
});
