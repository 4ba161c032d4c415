// A drawing of residuals of which each can be pointed at, and pressed to see its image there.
import { type JSX } from "preact";
import { useCallback, useState } from "preact/hooks";
import { Drawing, type Colours } from "../drawing/drawing";
import { nearest } from "../drawing/residuals";
import type { Point, Size } from "../drawing/viewport";
import { fixed } from "../format/numbers";
import { words } from "../words/language";
import { within } from "./pointer_place";
import type { RunCorner, Spot } from "./run_residuals";

/** How near the pointer must be to a residual, canvas px. */
const REACH_PX = 14;
const NOWHERE: Size = { width: 0, height: 0 };

interface Props {
  corners: readonly RunCorner[];
  /** Where a residual is drawn. */
  placeOf: (corner: RunCorner, size: Size) => Point;
  draw: (context: CanvasRenderingContext2D, size: Size, colours: Colours, pointed: RunCorner | null) => void;
  label: string;
  class?: string;
  /** Number of a capture. */
  numbers: ReadonlyMap<string, number>;
  onChoose: (spot: Spot) => void;
}

export function ResidualDrawing({
  corners,
  placeOf,
  draw,
  label,
  class: name,
  numbers,
  onChoose,
}: Props): JSX.Element {
  const say = words.value;
  const [size, setSize] = useState<Size>(NOWHERE);
  const [pointed, setPointed] = useState<RunCorner | null>(null);
  const drawPointed = useCallback(
    (context: CanvasRenderingContext2D, to: Size, colours: Colours) => draw(context, to, colours, pointed),
    [draw, pointed],
  );
  const find = (event: MouseEvent & { currentTarget: HTMLElement }): RunCorner | null => {
    const at = within(event.currentTarget, event);
    const places = corners.map((corner) => placeOf(corner, size));
    const found = nearest(places, at, REACH_PX);
    return found === null ? null : (corners[found] ?? null);
  };
  const choose = (event: MouseEvent & { currentTarget: HTMLElement }): void => {
    // What is read under the pointer is what is opened; a finger comes without having pointed.
    const found = pointed ?? find(event);
    if (found !== null) onChoose(found);
  };
  return (
    <>
      <div
        class={`pointable ${pointed === null ? "" : "pointed"} ${name ?? ""}`}
        onPointerMove={(event) => setPointed(find(event))}
        onPointerLeave={() => setPointed(null)}
        onClick={choose}
      >
        <Drawing draw={drawPointed} label={label} onSize={setSize} />
      </div>
      <p class="pointed-read muted">
        {pointed === null
          ? say.residual_press
          : say.residual_at(numbers.get(pointed.captureId) ?? 0, pointed.corner, fixed(pointed.length, 3))}
      </p>
    </>
  );
}
