// Residuals of all views: where they are in the image, and the rms of each view.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawField } from "../drawing/field_drawing";
import { gainFor, type CornerResidual } from "../drawing/residuals";
import type { Capture, Result } from "../generated/api";
import { words } from "../words/language";
import type { Residuals } from "./run_residuals";
import { ViewsTable } from "./views_table";

/** A typical residual is drawn about this long, as a share of the image's width. */
const ARROW_SHARE = 0.025;

interface Props {
  result: Result;
  captures: readonly Capture[];
  residuals: Residuals;
  chosenId: string;
  onChoose: (id: string) => void;
}

export function ResidualsPanel({ result, captures, residuals, chosenId, onChoose }: Props): JSX.Element {
  const say = words.value;
  const { all, byCapture } = residuals;
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
      <Field all={all} chosen={byCapture.get(chosenId) ?? []} result={result} />
      <ViewsTable views={result.views} captures={captures} chosenId={chosenId} onChoose={onChoose} />
    </section>
  );
}

interface FieldProps {
  all: readonly CornerResidual[];
  chosen: readonly CornerResidual[];
  result: Result;
}

function Field({ all, chosen, result }: FieldProps): JSX.Element {
  const say = words.value;
  const [width, height] = result.image_size;
  const gain = gainFor(result.rms_px, ARROW_SHARE * width);
  const draw = useCallback<Draw>(
    (context, size, colours) => {
      drawField(context, size, { residuals: all, chosen, imageSize: { width, height }, gain }, colours);
    },
    [all, chosen, width, height, gain],
  );
  return (
    <figure class="field-figure">
      <figcaption>
        <h3>{say.field_title}</h3>
        <span class="key muted">{say.field_gain(gain)}</span>
      </figcaption>
      <div class="field" style={{ aspectRatio: `${width} / ${height}` }}>
        <Drawing draw={draw} label={say.field_label(all.length)} />
      </div>
    </figure>
  );
}
