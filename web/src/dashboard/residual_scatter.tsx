// The cloud of all residuals around zero, with those of the capture on show picked out.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import type { Colours } from "../drawing/drawing";
import { rmsOf, scatterLimit } from "../drawing/residuals";
import { drawScatter, scatterFrame } from "../drawing/scatter_drawing";
import type { Point, Size } from "../drawing/viewport";
import { fixed } from "../format/numbers";
import { language, words } from "../words/language";
import { ResidualDrawing } from "./residual_drawing";
import type { RunCorner, Spot } from "./run_residuals";

interface Props {
  all: readonly RunCorner[];
  chosen: readonly RunCorner[];
  /** Number of the capture on show. */
  number: number;
  numbers: ReadonlyMap<string, number>;
  sigma: number;
  onChoose: (spot: Spot) => void;
}

export function ResidualScatter({ all, chosen, number, numbers, sigma, onChoose }: Props): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const limit = scatterLimit(all, sigma);
  const draw = useCallback(
    (context: CanvasRenderingContext2D, size: Size, colours: Colours, pointed: RunCorner | null) =>
      drawScatter(context, size, { residuals: all, chosen, pointed, sigma, limit }, colours, spoken),
    [all, chosen, sigma, limit, spoken],
  );
  const placeOf = useCallback(
    ({ du, dv }: RunCorner, size: Size): Point => {
      const { zero, scale } = scatterFrame(size, limit);
      return { x: zero.x + du * scale, y: zero.y + dv * scale };
    },
    [limit],
  );
  return (
    <figure class="scatter-figure">
      <figcaption>
        <h3>{say.scatter_title}</h3>
        <span class="key key-point">
          ● {say.scatter_all} {all.length}
        </span>
        <span class="key key-chosen">◆ {say.scatter_selected(number)}</span>
        <span class="key key-ring">◌ {say.scatter_rings(fixed(sigma, 3))}</span>
      </figcaption>
      <ResidualDrawing
        class="scatter"
        corners={all}
        placeOf={placeOf}
        draw={draw}
        label={say.scatter_label(all.length, fixed(rmsOf(all), 3))}
        numbers={numbers}
        onChoose={onChoose}
      />
    </figure>
  );
}
