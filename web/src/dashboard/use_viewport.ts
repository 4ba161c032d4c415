// Zooming and moving an image by wheel, hand, fingers and keys. The arithmetic is in drawing/viewport.ts.
import { useCallback, useEffect, useMemo, useRef, useState } from "preact/hooks";
import {
  centredOn,
  fit,
  keepInside,
  moveBy,
  toImage,
  zoomAt,
  type Point,
  type Size,
  type Viewport,
} from "../drawing/viewport";
import { within, type Move, type Place, type Zoom } from "./pointer_place";
import { useHands } from "./use_hands";

const WHEEL_RATE = 0.0016;
export const ZOOM_STEP = 1.5;
const KEY_MOVE_PX = 60;

export interface ViewportControl {
  view: Viewport;
  place: Place;
  /** Pointer over the image, in image coordinates; null when it is elsewhere. */
  pointer: Point | null;
  setCanvas: (size: Size) => void;
  zoom: (factor: number, at?: Point) => void;
  /** Puts a point of the image into the middle, so many canvas px per image px large. */
  lookAt: (at: Point, scale: number) => void;
  showAll: () => void;
}

export function useViewport(image: Size): ViewportControl {
  const place = useRef<HTMLDivElement>(null);
  const [canvas, setCanvas] = useState<Size>({ width: 0, height: 0 });
  // null: the whole image, whatever the size of the canvas.
  const [chosen, setChosen] = useState<Viewport | null>(null);
  const [pointer, setPointer] = useState<Point | null>(null);
  const whole = useMemo(() => fit(image, canvas), [image, canvas]);
  const view = useMemo(
    () => (chosen === null || chosen.scale <= whole.scale ? whole : keepInside(chosen, image, canvas)),
    [chosen, whole, image, canvas],
  );

  const zoom = useCallback(
    (factor: number, at: Point = { x: canvas.width / 2, y: canvas.height / 2 }) =>
      setChosen((now) => zoomAt(now ?? whole, at, factor, image, canvas)),
    [canvas, image, whole],
  );
  const move = useCallback(
    (by: Point) => setChosen((now) => moveBy(now ?? whole, by, image, canvas)),
    [canvas, image, whole],
  );
  const lookAt = useCallback(
    (at: Point, scale: number) => setChosen(centredOn(at, scale, image, canvas)),
    [canvas, image],
  );
  const showAll = useCallback(() => setChosen(null), []);

  useWheel(place, zoom);
  useHands(place, move, zoom);
  useKeys(place, move, zoom, showAll);
  useEffect(() => {
    const element = place.current;
    if (element === null) return undefined;
    const follow = (event: PointerEvent): void => setPointer(toImage(view, within(element, event)));
    const leave = (): void => setPointer(null);
    element.addEventListener("pointermove", follow);
    element.addEventListener("pointerleave", leave);
    return () => {
      element.removeEventListener("pointermove", follow);
      element.removeEventListener("pointerleave", leave);
    };
  }, [view]);

  return { view, place, pointer, setCanvas, zoom, lookAt, showAll };
}

function useWheel(place: Place, zoom: Zoom): void {
  useEffect(() => {
    const element = place.current;
    if (element === null) return undefined;
    const turn = (event: WheelEvent): void => {
      event.preventDefault();
      zoom(Math.exp(-event.deltaY * WHEEL_RATE), within(element, event));
    };
    // Not passive: the page must not scroll under a zoom.
    element.addEventListener("wheel", turn, { passive: false });
    return () => element.removeEventListener("wheel", turn);
  }, [place, zoom]);
}

const KEY_MOVES: Readonly<Record<string, Point>> = {
  ArrowLeft: { x: KEY_MOVE_PX, y: 0 },
  ArrowRight: { x: -KEY_MOVE_PX, y: 0 },
  ArrowUp: { x: 0, y: KEY_MOVE_PX },
  ArrowDown: { x: 0, y: -KEY_MOVE_PX },
};
const KEY_ZOOMS: Readonly<Record<string, number>> = { "+": ZOOM_STEP, "=": ZOOM_STEP, "-": 1 / ZOOM_STEP };

function useKeys(place: Place, move: Move, zoom: Zoom, showAll: () => void): void {
  useEffect(() => {
    const element = place.current;
    if (element === null) return undefined;
    const press = (event: KeyboardEvent): void => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const by = KEY_MOVES[event.key];
      const factor = KEY_ZOOMS[event.key];
      if (by !== undefined) move(by);
      else if (factor !== undefined) zoom(factor);
      else if (event.key === "0") showAll();
      else return;
      event.preventDefault();
    };
    element.addEventListener("keydown", press);
    return () => element.removeEventListener("keydown", press);
  }, [place, move, zoom, showAll]);
}
