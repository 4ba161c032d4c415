// Residuals of all views together: the cloud around zero, the field over the image, and each view's rms.
import { type JSX } from "preact";
import { useCallback, useMemo } from "preact/hooks";
import type { Capture, Result } from "../generated/api";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawField } from "../drawing/field_drawing";
import { cornerResiduals, gainFor, rmsOf, scatterLimit, type CornerResidual } from "../drawing/residuals";
import { drawScatter } from "../drawing/scatter_drawing";
import { fixed } from "../format/numbers";
import { language, words } from "../words/language";
import type { CaptureDetails } from "./capture_details";

const ARROW_SHARE = 0.02;
const NONE: readonly CornerResidual[] = [];

interface Props {
  result: Result;
  captures: readonly Capture[];
  details: CaptureDetails;
  chosenId: string;
}

export function ResidualsPanel({ result, captures, details, chosenId }: Props): JSX.Element {
  const say = words.value;
  const byId = useMemo(() => {
    const solved = [...details.values()].filter((detail) => detail.reprojected !== null);
    return new Map(solved.map((detail) => [detail.id, cornerResiduals(detail.corners, detail.reprojected)]));
  }, [details]);
  const all = useMemo(() => [...byId.values()].flat(), [byId]);
  const chosen = byId.get(chosenId) ?? NONE;
  const number = captures.find((capture) => capture.id === chosenId)?.number ?? 0;
  return (
    <section class="panel residuals-panel" aria-labelledby="residuals-title">
      <div class="panel-head">
        <h2 id="residuals-title">{say.residuals_title}</h2>
        <span class="muted">
          {details.size < captures.length
            ? say.residuals_loading(details.size, captures.length)
            : say.residuals_detail}
        </span>
      </div>
      <div class="columns columns-residuals">
        <Scatter all={all} chosen={chosen} result={result} number={number} />
        <Field all={all} chosen={chosen} result={result} />
      </div>
    </section>
  );
}

interface ChartProps {
  all: readonly CornerResidual[];
  chosen: readonly CornerResidual[];
  result: Result;
}

function Scatter({ all, chosen, result, number }: ChartProps & { number: number }): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const sigma = result.sigma_px;
  const draw = useCallback<Draw>(
    (context, size, colours) => {
      const scene = { residuals: all, chosen, sigma, limit: scatterLimit(all, sigma) };
      drawScatter(context, size, scene, colours, spoken);
    },
    [all, chosen, sigma, spoken],
  );
  return (
    <figure>
      <figcaption>
        <h3>{say.scatter_title}</h3>
        <span class="key key-point">● {all.length}</span>
        <span class="key key-chosen">◆ {say.scatter_selected(number)}</span>
        <span class="key key-ring">◌ {say.scatter_rings(fixed(sigma, 3))}</span>
      </figcaption>
      <Drawing class="scatter" draw={draw} label={say.scatter_label(all.length, fixed(rmsOf(all), 3))} />
    </figure>
  );
}

function Field({ all, chosen, result }: ChartProps): JSX.Element {
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
    <figure>
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
