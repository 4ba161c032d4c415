// Zooming and moving an image by wheel, hand and keys. The arithmetic is in drawing/viewport.ts.
import { type RefObject } from "preact";
import { useCallback, useEffect, useMemo, useRef, useState } from "preact/hooks";
import {
  fit,
  keepInside,
  moveBy,
  toImage,
  zoomAt,
  type Point,
  type Size,
  type Viewport,
} from "../drawing/viewport";

const WHEEL_RATE = 0.0016;
export const ZOOM_STEP = 1.5;
const KEY_MOVE_PX = 60;

export interface ViewportControl {
  view: Viewport;
  place: RefObject<HTMLDivElement | null>;
  /** Pointer over the image, in image coordinates; null when it is elsewhere. */
  pointer: Point | null;
  setCanvas: (size: Size) => void;
  zoom: (factor: number, at?: Point) => void;
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
  const showAll = useCallback(() => setChosen(null), []);

  useWheel(place, zoom);
  useDrag(place, move, zoom);
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

  return { view, place, pointer, setCanvas, zoom, showAll };
}

type Place = RefObject<HTMLDivElement | null>;
type Zoom = (factor: number, at?: Point) => void;
type Move = (by: Point) => void;

function within(element: HTMLElement, event: MouseEvent): Point {
  const box = element.getBoundingClientRect();
  return { x: event.clientX - box.left - element.clientLeft, y: event.clientY - box.top - element.clientTop };
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

function useDrag(place: Place, move: Move, zoom: Zoom): void {
  useEffect(() => {
    const element = place.current;
    if (element === null) return undefined;
    const drag = (event: PointerEvent): void => {
      if (element.hasPointerCapture(event.pointerId)) move({ x: event.movementX, y: event.movementY });
    };
    const grab = (event: PointerEvent): void => element.setPointerCapture(event.pointerId);
    const closer = (event: MouseEvent): void => zoom(8, within(element, event));
    element.addEventListener("pointerdown", grab);
    element.addEventListener("pointermove", drag);
    element.addEventListener("dblclick", closer);
    return () => {
      element.removeEventListener("pointerdown", grab);
      element.removeEventListener("pointermove", drag);
      element.removeEventListener("dblclick", closer);
    };
  }, [place, move, zoom]);
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
