// A canvas that fits its place, is sharp on every screen, and is drawn again when its size or the theme changes.
import { type JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { dark } from "../look/theme";
import type { Size } from "./viewport";

/** Resolves a token of tokens.css to a colour that a canvas understands. */
export type Colours = (token: string) => string;
export type Draw = (context: CanvasRenderingContext2D, size: Size, colours: Colours) => void;

interface Props {
  draw: Draw;
  label: string;
  class?: string;
  onSize?: (size: Size) => void;
}

export function Drawing({ draw, label, class: name, onSize }: Props): JSX.Element {
  const place = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [size, setSize] = useState<Size>({ width: 0, height: 0 });
  const isDark = dark.value;

  useLayoutEffect(() => {
    if (place.current === null) return undefined;
    const observer = new ResizeObserver(([entry]) => {
      if (entry === undefined) return;
      const { width, height } = entry.contentRect;
      setSize({ width, height });
      onSize?.({ width, height });
    });
    observer.observe(place.current);
    return () => observer.disconnect();
  }, [onSize]);

  useEffect(() => {
    if (canvas.current !== null && size.width > 0) paint(canvas.current, size, draw);
  }, [draw, size, isDark]);

  return (
    <div ref={place} class={`drawing ${name ?? ""}`}>
      <canvas ref={canvas} role="img" aria-label={label} />
    </div>
  );
}

function paint(canvas: HTMLCanvasElement, size: Size, draw: Draw): void {
  const context = canvas.getContext("2d");
  if (context === null) return;
  const density = window.devicePixelRatio;
  canvas.width = Math.round(size.width * density);
  canvas.height = Math.round(size.height * density);
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, size.width, size.height);
  draw(context, size, coloursOf(canvas));
}

export function coloursOf(element: HTMLElement): Colours {
  // light-dark() stays unresolved in a custom property; only a real property gives the colour itself.
  const resolved = new Map<string, string>();
  return (token) => {
    const known = resolved.get(token);
    if (known !== undefined) return known;
    element.style.color = `var(--${token})`;
    const colour = getComputedStyle(element).color;
    element.style.color = "";
    resolved.set(token, colour);
    return colour;
  };
}
