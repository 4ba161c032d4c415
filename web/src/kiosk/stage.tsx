// The live picture: one canvas, drawn whenever a picture comes with its state, and not by the pages' clock.
import { effect } from "@preact/signals";
import { type JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Size } from "../drawing/viewport";
import { words } from "../words/language";
import { BoardHand } from "./board_hand";
import { Figures } from "./figures";
import type { Kiosk } from "./kiosk";
import { isLive } from "./kiosk_state";
import { drawStage } from "./stage_drawing";
import { sceneOf } from "./stage_scene";

export function Stage({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { count } = kiosk.state.value.stored;

  useEffect(() => {
    const element = canvas.current;
    if (element === null) return undefined;
    const colours = rootColours();
    let size: Size = { width: 0, height: 0 };
    const draw = (): void => paint(element, size, kiosk, colours);
    const observer = new ResizeObserver(([entry]) => {
      if (entry === undefined) return;
      size = { width: entry.contentRect.width, height: entry.contentRect.height };
      draw();
    });
    observer.observe(element);
    const stop = effect(draw);
    return () => {
      observer.disconnect();
      stop();
    };
  }, [kiosk]);

  return (
    <div class={`stage ${isLive(kiosk.state.value) ? "" : "stage-lost"}`}>
      <canvas ref={canvas} role="img" aria-label={words.value.guide_picture} />
      {kiosk.state.value.welcome?.moves_board === true && <BoardHand kiosk={kiosk} />}
      {kiosk.figures.value && <Figures kiosk={kiosk} />}
      {count > 0 && <div key={count} class="stage-flash" aria-hidden="true" />}
    </div>
  );
}

function paint(
  canvas: HTMLCanvasElement,
  size: Size,
  kiosk: Kiosk,
  colours: (token: string) => string,
): void {
  const { picture, live } = kiosk.shown.value;
  const isMirrored = kiosk.mirrored.value;
  const { run } = kiosk.state.peek();
  const context = canvas.getContext("2d", { alpha: false });
  if (run === null || context === null || size.width === 0) return;
  const density = window.devicePixelRatio;
  const [width, height] = [Math.round(size.width * density), Math.round(size.height * density)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  context.setTransform(density, 0, 0, density, 0, 0);
  const imageSize = { width: run.image_size[0], height: run.image_size[1] };
  const scene = live === null ? null : sceneOf(run, live);
  drawStage(context, size, { image: picture, imageSize, isMirrored }, scene, colours);
}

/** Colours over a picture are the same in light and dark, so they are read once. */
function rootColours(): (token: string) => string {
  const style = getComputedStyle(document.documentElement);
  const known = new Map<string, string>();
  return (token) => {
    const colour = known.get(token) ?? style.getPropertyValue(`--${token}`).trim();
    known.set(token, colour);
    return colour;
  };
}
