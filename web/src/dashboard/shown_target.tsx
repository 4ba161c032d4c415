// A target over the whole screen at true size, black on white whatever the theme, with what to declare below it.
import { type JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { coloursOf } from "../drawing/drawing";
import { drawPattern, placePattern } from "../drawing/target_drawing";
import type { Size } from "../drawing/viewport";
import { fixed, plain, withUnit } from "../format/numbers";
import type { TargetPattern } from "../generated/api";
import { words } from "../words/language";
import { scaledSpec, trueSize } from "./screen_scale";
import { squareName } from "./target_words";
import { TooLarge } from "./too_large";
import { useFullScreen } from "./use_full_screen";

interface Props {
  pattern: TargetPattern;
  /** Device pixels per mm. */
  density: number;
  onClose: () => void;
}

export function ShownTarget({ pattern, density, onClose }: Props): JSX.Element {
  const dialog = useRef<HTMLDialogElement>(null);
  const [room, setRoom] = useState<Size | null>(null);
  const { factor } = trueSize(1000 * (pattern.step_m ?? 0), density);
  const perMm = density * factor;
  useEffect(() => dialog.current?.showModal(), []);
  useFullScreen(onClose);
  const fits = room === null || placePattern(pattern, room, 1000 * perMm) !== null;
  return (
    <dialog
      class="shown-target"
      ref={dialog}
      aria-label={words.value.show_label(pattern.spec)}
      onClose={onClose}
    >
      <Ground pattern={pattern} perMm={perMm} onRoom={setRoom} />
      {room !== null && !fits && (
        <div class="shown-too-large">
          <TooLarge pattern={pattern} density={perMm} screen={room} />
        </div>
      )}
      <div class="shown-caption">
        {fits && <Caption pattern={pattern} factor={factor} density={density} />}
        <button type="button" onClick={onClose}>
          {words.value.show_close}
        </button>
      </div>
    </dialog>
  );
}

interface GroundProps {
  pattern: TargetPattern;
  perMm: number;
  onRoom: (room: Size) => void;
}

/** The white ground with the pattern, pixel by pixel of the device. */
function Ground({ pattern, perMm, onRoom }: GroundProps): JSX.Element {
  const place = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  useLayoutEffect(() => {
    if (place.current === null) return undefined;
    const observer = new ResizeObserver(([entry]) => {
      const drawn = canvas.current;
      if (entry === undefined || drawn === null) return;
      const room = deviceSize(entry);
      paint(drawn, room, pattern, perMm);
      onRoom(room);
    });
    try {
      observer.observe(place.current, { box: "device-pixel-content-box" });
    } catch {
      // Safari does not know device pixels; there the size is rounded.
      observer.observe(place.current);
    }
    return () => observer.disconnect();
  }, [pattern, perMm, onRoom]);
  return (
    <div class="shown-ground" ref={place}>
      <canvas ref={canvas} role="img" aria-label={words.value.show_label(pattern.spec)} />
    </div>
  );
}

function deviceSize(entry: ResizeObserverEntry): Size {
  const ratio = window.devicePixelRatio;
  const { width, height } = entry.contentRect;
  const exact = (entry as Partial<ResizeObserverEntry>).devicePixelContentBoxSize?.[0];
  // A ratio that developer tools make up is not in what the browser calls device pixels.
  if (exact !== undefined && Math.abs(exact.inlineSize - width * ratio) <= 1) {
    return { width: exact.inlineSize, height: exact.blockSize };
  }
  return { width: Math.round(width * ratio), height: Math.round(height * ratio) };
}

function paint(canvas: HTMLCanvasElement, room: Size, pattern: TargetPattern, perMm: number): void {
  canvas.width = room.width;
  canvas.height = room.height;
  const context = canvas.getContext("2d", { alpha: false });
  if (context === null) return;
  const colours = coloursOf(canvas);
  context.fillStyle = colours("target-ground");
  context.fillRect(0, 0, room.width, room.height);
  const place = placePattern(pattern, room, 1000 * perMm);
  if (place !== null) drawPattern(context, pattern, place, colours("target-ink"));
}

interface CaptionProps {
  pattern: TargetPattern;
  factor: number;
  density: number;
}

/** What to declare, and how to check it. */
function Caption({ pattern, factor, density }: CaptionProps): JSX.Element {
  const say = words.value;
  const millimetres = (lengths: readonly number[]): string =>
    withUnit(lengths.map((length) => fixed(1000 * length * factor, 2)).join(" × "), "mm");
  return (
    <>
      <span>
        {say.show_declare} <b>{scaledSpec(pattern.spec, factor)}</b>
      </span>
      <span>
        {say.show_measure} {squareName(pattern.spec, say)} {millimetres([pattern.square_m])},{" "}
        {say.show_over_all} {millimetres(pattern.size_m)}
      </span>
      <span class="shown-density">{say.show_density(fixed(density, 3), plain(window.devicePixelRatio))}</span>
    </>
  );
}
