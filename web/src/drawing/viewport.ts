// Which part of an image a canvas shows: zoom and move as pure functions.
// Image coordinates are the service's: (0, 0) is the centre of the top-left pixel, so its corner is (-0.5, -0.5).

export interface Size {
  width: number;
  height: number;
}

export interface Point {
  x: number;
  y: number;
}

/** `scale` canvas px per image px; (left, top) is the image coordinate in the canvas's top-left corner. */
export interface Viewport {
  scale: number;
  left: number;
  top: number;
}

export const LARGEST_SCALE = 64;

export function fit(image: Size, canvas: Size): Viewport {
  const scale = Math.min(canvas.width / image.width, canvas.height / image.height);
  return {
    scale,
    left: -0.5 - (canvas.width / scale - image.width) / 2,
    top: -0.5 - (canvas.height / scale - image.height) / 2,
  };
}

export function toCanvas(view: Viewport, point: Point): Point {
  return { x: (point.x - view.left) * view.scale, y: (point.y - view.top) * view.scale };
}

export function toImage(view: Viewport, point: Point): Point {
  return { x: point.x / view.scale + view.left, y: point.y / view.scale + view.top };
}

/** Zooms so that what is under `at` (canvas px) stays there. */
export function zoomAt(view: Viewport, at: Point, factor: number, image: Size, canvas: Size): Viewport {
  const smallest = fit(image, canvas).scale;
  const scale = Math.min(LARGEST_SCALE, Math.max(smallest, view.scale * factor));
  const held = toImage(view, at);
  return keepInside({ scale, left: held.x - at.x / scale, top: held.y - at.y / scale }, image, canvas);
}

/** Puts a point of the image into the middle, at a scale within the bounds. */
export function centredOn(at: Point, scale: number, image: Size, canvas: Size): Viewport {
  const bounded = Math.min(LARGEST_SCALE, Math.max(fit(image, canvas).scale, scale));
  const [left, top] = [at.x - canvas.width / 2 / bounded, at.y - canvas.height / 2 / bounded];
  return keepInside({ scale: bounded, left, top }, image, canvas);
}

/** Moves the image by canvas px, as a hand that drags it does. */
export function moveBy(view: Viewport, by: Point, image: Size, canvas: Size): Viewport {
  const moved = { ...view, left: view.left - by.x / view.scale, top: view.top - by.y / view.scale };
  return keepInside(moved, image, canvas);
}

/** No empty margin where the image is larger than the canvas; centred where it is smaller. */
export function keepInside(view: Viewport, image: Size, canvas: Size): Viewport {
  return {
    scale: view.scale,
    left: keepAxis(view.left, image.width, canvas.width / view.scale),
    top: keepAxis(view.top, image.height, canvas.height / view.scale),
  };
}

function keepAxis(start: number, whole: number, shown: number): number {
  if (shown >= whole) return -0.5 - (shown - whole) / 2;
  return Math.min(Math.max(start, -0.5), whole - 0.5 - shown);
}
