// Residual vectors over the image: of all views in one field, or a small field for each view.
import { type JSX } from "preact";
import { useCallback } from "preact/hooks";
import { Drawing, type Colours, type Draw } from "../drawing/drawing";
import { drawField } from "../drawing/field_drawing";
import { imageToCanvas } from "../drawing/image_frame";
import type { Point, Size } from "../drawing/viewport";
import { words } from "../words/language";
import { ResidualDrawing } from "./residual_drawing";
import type { Residuals, RunCorner, Spot } from "./run_residuals";

const NONE: readonly RunCorner[] = [];

interface Props {
  residuals: Residuals;
  chosenId: string;
  numbers: ReadonlyMap<string, number>;
  imageSize: [number, number];
  /** Vectors are drawn so many times longer than they are. */
  gain: number;
  onChoose: (spot: Spot) => void;
}

export function PooledField({ residuals, chosenId, numbers, imageSize, gain, onChoose }: Props): JSX.Element {
  const [width, height] = imageSize;
  const { all, byCapture } = residuals;
  const chosen = byCapture.get(chosenId) ?? NONE;
  const draw = useCallback(
    (context: CanvasRenderingContext2D, size: Size, colours: Colours, pointed: RunCorner | null) =>
      drawField(
        context,
        size,
        { residuals: all, chosen, pointed, imageSize: { width, height }, gain },
        colours,
      ),
    [all, chosen, width, height, gain],
  );
  const placeOf = useCallback(
    ({ reprojected }: RunCorner, size: Size): Point => imageToCanvas({ width, height }, size)(reprojected),
    [width, height],
  );
  return (
    <>
      <div class="field" style={{ aspectRatio: `${width} / ${height}` }}>
        <ResidualDrawing
          class="fill"
          corners={all}
          placeOf={placeOf}
          draw={draw}
          label={words.value.field_label(all.length)}
          numbers={numbers}
          onChoose={onChoose}
        />
      </div>
    </>
  );
}

export function ViewFields({ residuals, chosenId, numbers, imageSize, gain, onChoose }: Props): JSX.Element {
  return (
    <ol class="view-fields">
      {[...residuals.byCapture].map(([id, corners]) => (
        <li key={id}>
          <button
            type="button"
            class="view-field"
            aria-pressed={id === chosenId}
            onClick={() => onChoose({ captureId: id, corner: null })}
          >
            <ViewField corners={corners} imageSize={imageSize} gain={gain} number={numbers.get(id) ?? 0} />
            <span aria-hidden="true">{numbers.get(id)}</span>
          </button>
        </li>
      ))}
    </ol>
  );
}

interface ViewFieldProps {
  corners: readonly RunCorner[];
  imageSize: [number, number];
  gain: number;
  number: number;
}

function ViewField({ corners, imageSize: [width, height], gain, number }: ViewFieldProps): JSX.Element {
  const draw = useCallback<Draw>(
    (context, size, colours) =>
      drawField(
        context,
        size,
        { residuals: corners, chosen: NONE, pointed: null, imageSize: { width, height }, gain },
        colours,
      ),
    [corners, width, height, gain],
  );
  return (
    <div style={{ aspectRatio: `${width} / ${height}` }}>
      <Drawing draw={draw} label={words.value.capture_number(number)} />
    </div>
  );
}
