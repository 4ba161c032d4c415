// Mouse and fingers on an image: drag, pinch, double click. What they mean is in pinch.ts.
import { useEffect } from "preact/hooks";
import type { Point } from "../drawing/viewport";
import { gestureOf } from "./pinch";
import { within, type Move, type Place, type Zoom } from "./pointer_place";

const CLOSER = 8;

export function useHands(place: Place, move: Move, zoom: Zoom): void {
  useEffect(() => {
    const element = place.current;
    if (element === null) return undefined;
    const held = new Map<number, Point>();
    const grab = (event: PointerEvent): void => {
      element.setPointerCapture(event.pointerId);
      held.set(event.pointerId, within(element, event));
    };
    const drag = (event: PointerEvent): void => {
      if (!held.has(event.pointerId)) return;
      const before = [...held.values()];
      held.set(event.pointerId, within(element, event));
      const gesture = gestureOf(before, [...held.values()]);
      if (gesture === null) return;
      move(gesture.by);
      if (gesture.factor !== 1) zoom(gesture.factor, gesture.at);
    };
    const release = (event: PointerEvent): void => {
      held.delete(event.pointerId);
    };
    const closer = (event: MouseEvent): void => zoom(CLOSER, within(element, event));
    element.addEventListener("pointerdown", grab);
    element.addEventListener("pointermove", drag);
    element.addEventListener("pointerup", release);
    element.addEventListener("pointercancel", release);
    element.addEventListener("dblclick", closer);
    return () => {
      element.removeEventListener("pointerdown", grab);
      element.removeEventListener("pointermove", drag);
      element.removeEventListener("pointerup", release);
      element.removeEventListener("pointercancel", release);
      element.removeEventListener("dblclick", closer);
    };
  }, [place, move, zoom]);
}
