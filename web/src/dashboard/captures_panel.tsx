// The run's images: a strip to choose from, the chosen one large, and what is known about it.
import { type JSX } from "preact";
import type { Capture, CaptureDetail, Result, ViewResult } from "../generated/api";
import { fixed, percent, significant, withUnit } from "../format/numbers";
import { useImage } from "../shell/images";
import type { Words } from "../words/en";
import { words } from "../words/language";
import { CaptureViewer } from "./capture_viewer";
import { Facts, type Fact } from "./facts";
import { LongestResiduals } from "./longest_residuals";
import { ResidualScatter } from "./residual_scatter";
import type { Residuals, RunCorner, Spot } from "./run_residuals";
import { boardTiltDeg, distanceM } from "./view_pose";

const NO_CORNERS: readonly RunCorner[] = [];

interface Props {
  captures: readonly Capture[];
  chosen: Capture;
  detail: CaptureDetail | null;
  result: Result | null;
  residuals: Residuals;
  /** Numbers of the captures by their ids. */
  numbers: ReadonlyMap<string, number>;
  spot: Spot | null;
  onChoose: (spot: Spot) => void;
}

export function CapturesPanel(props: Props): JSX.Element {
  const { captures, chosen, detail, result, residuals, numbers, spot } = props;
  const say = words.value;
  const onChoose = (captureId: string): void => props.onChoose({ captureId, corner: null });
  const at = captures.indexOf(chosen);
  const step = (by: number): void => {
    const next = captures[at + by];
    if (next !== undefined) onChoose(next.id);
  };
  const views = result?.views ?? [];
  const view = views.find((candidate) => candidate.capture_id === chosen.id);
  return (
    <section class="panel captures-panel" id="captures" aria-labelledby="captures-title">
      <div class="panel-head">
        <h2 id="captures-title">{say.captures_title}</h2>
        <div class="stepper">
          <button type="button" aria-label={say.previous_capture} disabled={at <= 0} onClick={() => step(-1)}>
            ‹
          </button>
          <span>
            {chosen.number} / {captures.length}
          </span>
          <button
            type="button"
            aria-label={say.next_capture}
            disabled={at >= captures.length - 1}
            onClick={() => step(1)}
          >
            ›
          </button>
        </div>
      </div>
      <ol class="strip">
        {captures.map((capture) => (
          <Thumbnail
            key={capture.id}
            capture={capture}
            view={views.find((candidate) => candidate.capture_id === capture.id)}
            chosen={capture === chosen}
            onChoose={onChoose}
          />
        ))}
      </ol>
      <div class="columns columns-viewer">
        <CaptureViewer capture={chosen} detail={detail} spot={spot} />
        <div class="viewer-side">
          <Facts facts={factsOf(chosen, detail, view, say)} />
          {result !== null && (
            <>
              <ResidualScatter
                all={residuals.all}
                chosen={residuals.byCapture.get(chosen.id) ?? NO_CORNERS}
                number={chosen.number}
                numbers={numbers}
                sigma={result.sigma_px}
                onChoose={props.onChoose}
              />
              <LongestResiduals
                all={residuals.all}
                numbers={numbers}
                sigma={result.sigma_px}
                spot={spot}
                onChoose={props.onChoose}
              />
            </>
          )}
        </div>
      </div>
    </section>
  );
}

interface ThumbnailProps {
  capture: Capture;
  view: ViewResult | undefined;
  chosen: boolean;
  onChoose: (id: string) => void;
}

function Thumbnail({ capture, view, chosen, onChoose }: ThumbnailProps): JSX.Element {
  const say = words.value;
  const image = useImage(capture.image_url);
  const label = say.capture_number(capture.number);
  const rms = view === undefined ? "" : withUnit(fixed(view.rms_px, 3), "px");
  return (
    <li>
      <button
        type="button"
        class="thumbnail"
        aria-pressed={chosen}
        aria-label={`${label} ${rms}`.trim()}
        title={capture.file_name}
        onClick={() => onChoose(capture.id)}
      >
        {image.state === "ready" ? (
          <img src={image.objectUrl} alt="" />
        ) : (
          <span class="thumbnail-empty">{image.state === "failed" ? "×" : ""}</span>
        )}
        <span class="thumbnail-line">
          <b>{capture.number}</b> {/* a space for those who hear it */}
          <span>{rms}</span>
        </span>
      </button>
    </li>
  );
}

function factsOf(
  capture: Capture,
  detail: CaptureDetail | null,
  view: ViewResult | undefined,
  say: Words,
): Fact[] {
  return [
    ...viewFacts(view, say),
    ...(detail === null ? [] : cornerFacts(detail, say)),
    { name: say.fact_edge_width, value: withUnit(fixed(capture.edge_width_px, 2), "px") },
    ...(capture.match_error_px === null
      ? []
      : [{ name: say.fact_match_error, value: withUnit(significant(capture.match_error_px), "px") }]),
    { name: say.fact_image_size, value: capture.image_size.join(" × ") },
    { name: say.fact_file, value: capture.file_name, title: capture.file_name },
    { name: say.fact_hash, value: `${capture.sha256.slice(0, 12)}…`, title: capture.sha256 },
  ];
}

function viewFacts(view: ViewResult | undefined, say: Words): Fact[] {
  if (view === undefined) return [];
  return [
    { name: say.fact_view_rms, value: withUnit(fixed(view.rms_px, 3), "px") },
    { name: say.fact_view_max, value: withUnit(fixed(view.max_px, 3), "px") },
    { name: say.fact_distance, value: withUnit(fixed(distanceM(view.pose.tvec), 3), "m") },
    { name: say.fact_tilt, value: `${fixed(boardTiltDeg(view.pose.rvec), 1)}°` },
  ];
}

function cornerFacts(detail: CaptureDetail, say: Words): Fact[] {
  return [
    { name: say.fact_corners, value: String(detail.corners.length) },
    { name: say.fact_contrast, value: withUnit(fixed(detail.contrast, 0), say.grey_levels) },
    { name: say.fact_parity, value: fixed(detail.parity_separation, 2) },
    ...(detail.saturated_share === null
      ? []
      : [{ name: say.fact_saturated, value: percent(detail.saturated_share) }]),
  ];
}
