// One capture large: where each corner was seen, where the calibration puts it, and the residual between, enlarged.
import { type JSX } from "preact";
import { useCallback, useEffect, useMemo, useState } from "preact/hooks";
import type { Capture, CaptureDetail } from "../generated/api";
import { drawCapture, type CaptureScene } from "../drawing/capture_drawing";
import { Drawing, type Draw } from "../drawing/drawing";
import { cornerResiduals, gainFor, GAINS, nearest, pointOf, rmsOf } from "../drawing/residuals";
import type { Size, Viewport } from "../drawing/viewport";
import { fixed, signed } from "../format/numbers";
import { useDrawable, useImage } from "../shell/images";
import type { Words } from "../words/en";
import { words } from "../words/language";
import type { Spot } from "./run_residuals";
import { useViewport, ZOOM_STEP } from "./use_viewport";

const NO_CORNERS: readonly number[][] = [];
/** How near the pointer must be to a corner to choose it, canvas px. */
const REACH_PX = 18;
/** A typical residual is drawn about this long, as a share of the image's width. */
const ARROW_SHARE = 0.025;
/** How large a corner is looked at that was chosen elsewhere, canvas px per image px. */
const CORNER_SCALE = 8;

type Layers = CaptureScene["show"];

interface Props {
  capture: Capture;
  detail: CaptureDetail | null;
  /** What was chosen elsewhere, such as a residual in a chart; it is looked at each time it is chosen. */
  spot: Spot | null;
}

export function CaptureViewer({ capture, detail, spot }: Props): JSX.Element {
  const say = words.value;
  const [width, height] = capture.image_size;
  const imageSize = useMemo<Size>(() => ({ width, height }), [width, height]);
  const image = useImage(capture.image_url);
  const drawable = useDrawable(image);
  const control = useViewport(imageSize);
  const [show, setShow] = useState<Layers>({ detected: true, reprojected: true, residuals: true });
  const [chosenGain, setGain] = useState<number | null>(null);

  const detected = useMemo(() => (detail?.corners ?? NO_CORNERS).map(pointOf), [detail]);
  const residuals = useMemo(
    () => cornerResiduals(detail?.corners ?? NO_CORNERS, detail?.reprojected ?? null),
    [detail],
  );
  const gain = chosenGain ?? gainFor(rmsOf(residuals), ARROW_SHARE * width);
  const { view, pointer, lookAt } = control;
  const held = spot?.captureId === capture.id ? spot.corner : null;
  const target = held === null ? undefined : detected[held];
  useEffect(() => {
    if (target !== undefined) lookAt(target, CORNER_SCALE);
  }, [spot, target, lookAt]);
  const pointed = pointer === null ? null : nearest(detected, pointer, REACH_PX / view.scale);
  const chosen = pointed ?? held;

  const draw = useCallback<Draw>(
    (context, size, colours) => {
      const scene = { image: drawable, imageSize, detected, residuals, gain, show, chosen };
      drawCapture(context, size, view, scene, colours);
    },
    [drawable, imageSize, detected, residuals, gain, show, chosen, view],
  );

  return (
    <div class="viewer">
      <Layer
        say={say}
        show={show}
        onShow={setShow}
        gain={gain}
        onGain={setGain}
        solved={residuals.length > 0}
      />
      <div
        class="viewer-place"
        ref={control.place}
        tabIndex={0}
        role="group"
        aria-label={say.viewer_keys}
        style={{ aspectRatio: `${width} / ${height}` }}
      >
        <Drawing draw={draw} label={say.viewer_label(capture.number)} onSize={control.setCanvas} />
        {image.state === "failed" && <p class="viewer-lost">{say.capture_image_lost}</p>}
      </div>
      <div class="viewer-foot">
        <Readout chosen={chosen} detail={detail} residuals={residuals} say={say} />
        <Zoom say={say} view={view} onZoom={control.zoom} onFit={control.showAll} />
      </div>
    </div>
  );
}

interface LayerProps {
  say: Words;
  show: Layers;
  onShow: (show: Layers) => void;
  gain: number;
  onGain: (gain: number) => void;
  solved: boolean;
}

function Layer({ say, show, onShow, gain, onGain, solved }: LayerProps): JSX.Element {
  const names: readonly [keyof Layers, string][] = [
    ["detected", say.show_detected],
    ["reprojected", say.show_reprojected],
    ["residuals", say.show_residuals],
  ];
  return (
    <div class="viewer-head">
      {names.map(([layer, name]) => (
        <label key={layer} class="layer">
          <input
            type="checkbox"
            checked={show[layer]}
            disabled={layer !== "detected" && !solved}
            onChange={(event) => onShow({ ...show, [layer]: event.currentTarget.checked })}
          />
          <LayerKey layer={layer} />
          {name}
        </label>
      ))}
      <label class="gain">
        {say.residual_gain}
        <select
          value={gain}
          disabled={!solved}
          onChange={(event) => onGain(Number(event.currentTarget.value))}
        >
          {GAINS.map((choice) => (
            <option key={choice} value={choice}>
              × {choice}
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}

function LayerKey({ layer }: { layer: keyof Layers }): JSX.Element {
  const mark = {
    detected: <circle cx="9" cy="9" r="5" />,
    reprojected: <path d="M5 5 L13 13 M5 13 L13 5" />,
    residuals: <path d="M4 13 L14 5" />,
  }[layer];
  return (
    <svg class={`layer-key layer-${layer}`} width="18" height="18" viewBox="0 0 18 18" aria-hidden="true">
      {mark}
    </svg>
  );
}

interface ReadoutProps {
  chosen: number | null;
  detail: CaptureDetail | null;
  residuals: ReturnType<typeof cornerResiduals>;
  say: Words;
}

function Readout({ chosen, detail, residuals, say }: ReadoutProps): JSX.Element {
  const corner = chosen === null ? undefined : detail?.corners[chosen];
  if (chosen === null || corner === undefined) return <span class="muted">{say.viewer_keys}</span>;
  const { x, y } = pointOf(corner);
  const residual = residuals[chosen];
  return (
    <output>
      {say.corner_readout(chosen, fixed(x, 2), fixed(y, 2))}
      {residual !== undefined &&
        ` · ${say.corner_residual(signed(residual.du, 3), signed(residual.dv, 3), fixed(residual.length, 3))}`}
    </output>
  );
}

interface ZoomProps {
  say: Words;
  view: Viewport;
  onZoom: (factor: number) => void;
  onFit: () => void;
}

function Zoom({ say, view, onZoom, onFit }: ZoomProps): JSX.Element {
  return (
    <div class="zoom">
      <button type="button" aria-label={say.viewer_zoom_out} onClick={() => onZoom(1 / ZOOM_STEP)}>
        −
      </button>
      <span class="zoom-value">{say.viewer_zoom(fixed(view.scale, view.scale < 10 ? 2 : 1))}</span>
      <button type="button" aria-label={say.viewer_zoom_in} onClick={() => onZoom(ZOOM_STEP)}>
        +
      </button>
      <button type="button" onClick={onFit}>
        {say.viewer_fit}
      </button>
    </div>
  );
}
