// Residuals of all views: where they are in the image, pooled or view by view, and the rms of each view.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { gainFor } from "../drawing/residuals";
import type { Capture, Result } from "../generated/api";
import { words } from "../words/language";
import { PooledField, ViewFields } from "./residual_fields";
import type { Residuals, Spot } from "./run_residuals";
import { ViewsTable } from "./views_table";

/** A typical residual is drawn about this long, as a share of the image's width. */
const ARROW_SHARE = { pooled: 0.025, single: 0.06 };

interface Props {
  result: Result;
  captures: readonly Capture[];
  numbers: ReadonlyMap<string, number>;
  residuals: Residuals;
  chosenId: string;
  onChoose: (spot: Spot) => void;
}

export function ResidualsPanel(props: Props): JSX.Element {
  const { result, captures, numbers, residuals, chosenId, onChoose } = props;
  const say = words.value;
  const [isPooled, setPooled] = useState(true);
  const { all, byCapture } = residuals;
  const [width] = result.image_size;
  const gain = gainFor(result.rms_px, (isPooled ? ARROW_SHARE.pooled : ARROW_SHARE.single) * width);
  const drawn = { residuals, chosenId, numbers, imageSize: result.image_size, gain, onChoose };
  return (
    <section class="panel residuals-panel" aria-labelledby="residuals-title">
      <div class="panel-head">
        <h2 id="residuals-title">{say.residuals_title}</h2>
        <span class="muted">
          {byCapture.size < result.views.length
            ? say.residuals_loading(byCapture.size, result.views.length)
            : say.residuals_corners(all.length)}
        </span>
      </div>
      <figure class="field-figure">
        <figcaption>
          <h3>{say.field_title}</h3>
          <span class="key muted">{say.field_gain(gain)}</span>
          <span class="segments" role="group" aria-label={say.field_title}>
            <button type="button" aria-pressed={isPooled} onClick={() => setPooled(true)}>
              {say.field_pooled}
            </button>
            <button type="button" aria-pressed={!isPooled} onClick={() => setPooled(false)}>
              {say.field_by_view}
            </button>
          </span>
        </figcaption>
        {isPooled ? <PooledField {...drawn} /> : <ViewFields {...drawn} />}
      </figure>
      <ViewsTable
        views={result.views}
        captures={captures}
        chosenId={chosenId}
        onChoose={(captureId) => onChoose({ captureId, corner: null })}
      />
    </section>
  );
}
