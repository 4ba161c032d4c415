import { describe, expect, it } from "vitest";
import { fit, keepInside, LARGEST_SCALE, moveBy, toCanvas, toImage, zoomAt } from "./viewport";

const image = { width: 1280, height: 800 };
const canvas = { width: 640, height: 480 };

describe("an image fitted into a canvas", () => {
  const view = fit(image, canvas);

  it("is shown whole and centred", () => {
    expect(view.scale).toBe(0.5);
    expect(toCanvas(view, { x: -0.5, y: -0.5 })).toEqual({ x: 0, y: 40 });
    expect(toCanvas(view, { x: 1279.5, y: 799.5 })).toEqual({ x: 640, y: 440 });
  });

  it("has the centre of its top-left pixel at (0, 0), half a pixel inside", () => {
    expect(toCanvas(view, { x: 0, y: 0 })).toEqual({ x: 0.25, y: 40.25 });
  });

  it("is found again from the canvas", () => {
    const point = { x: 333.25, y: 71.5 };
    const back = toImage(view, toCanvas(view, point));
    expect(back.x).toBeCloseTo(point.x, 9);
    expect(back.y).toBeCloseTo(point.y, 9);
  });
});

describe("zooming", () => {
  it("keeps what is under the pointer under the pointer", () => {
    const at = { x: 200, y: 250 };
    const before = fit(image, canvas);
    const after = zoomAt(before, at, 6, image, canvas);
    const held = toImage(before, at);
    expect(after.scale).toBe(3);
    expect(toImage(after, at).x).toBeCloseTo(held.x, 9);
    expect(toImage(after, at).y).toBeCloseTo(held.y, 9);
  });

  it("ends at the whole image and at the largest scale", () => {
    const at = { x: 10, y: 10 };
    expect(zoomAt(fit(image, canvas), at, 0.01, image, canvas)).toEqual(fit(image, canvas));
    expect(zoomAt(fit(image, canvas), at, 1e6, image, canvas).scale).toBe(LARGEST_SCALE);
  });
});

describe("moving", () => {
  it("follows the hand", () => {
    const start = zoomAt(fit(image, canvas), { x: 320, y: 240 }, 8, image, canvas);
    const moved = moveBy(start, { x: 40, y: -20 }, image, canvas);
    expect(moved.left).toBeCloseTo(start.left - 10, 9);
    expect(moved.top).toBeCloseTo(start.top + 5, 9);
  });

  it("stops at the image's edges", () => {
    const start = zoomAt(fit(image, canvas), { x: 320, y: 240 }, 4, image, canvas);
    const moved = moveBy(start, { x: 1e5, y: -1e5 }, image, canvas);
    expect(moved.left).toBe(-0.5);
    expect(moved.top).toBe(799.5 - 480 / 2);
  });

  it("centres the direction in which everything is shown", () => {
    const view = keepInside({ scale: 0.6, left: 100, top: 700 }, image, canvas);
    expect(toCanvas(view, { x: 0, y: 399.5 }).y).toBeCloseTo(240, 9);
  });
});
