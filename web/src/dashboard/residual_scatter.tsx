// The cloud of all residuals around zero, with those of the capture on show picked out.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { Drawing, type Draw } from "../drawing/drawing";
import { rmsOf, scatterLimit, type CornerResidual } from "../drawing/residuals";
import { drawScatter } from "../drawing/scatter_drawing";
import { fixed } from "../format/numbers";
import { language, words } from "../words/language";

interface Props {
  all: readonly CornerResidual[];
  chosen: readonly CornerResidual[];
  /** Number of the capture on show. */
  number: number;
  sigma: number;
}

export function ResidualScatter({ all, chosen, number, sigma }: Props): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const draw = useCallback<Draw>(
    (context, size, colours) => {
      const scene = { residuals: all, chosen, sigma, limit: scatterLimit(all, sigma) };
      drawScatter(context, size, scene, colours, spoken);
    },
    [all, chosen, sigma, spoken],
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
      <Drawing class="scatter" draw={draw} label={say.scatter_label(all.length, fixed(rmsOf(all), 3))} />
    </figure>
  );
}
