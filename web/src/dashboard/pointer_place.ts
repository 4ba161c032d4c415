// Where a pointer is within the element that it works on, and what the hands there may do.
import { type RefObject } from "preact";
import type { Point } from "../drawing/viewport";

export type Place = RefObject<HTMLDivElement | null>;
export type Zoom = (factor: number, at?: Point) => void;
export type Move = (by: Point) => void;

export function within(element: HTMLElement, event: MouseEvent): Point {
  const box = element.getBoundingClientRect();
  return { x: event.clientX - box.left - element.clientLeft, y: event.clientY - box.top - element.clientTop };
}
