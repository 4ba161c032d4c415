// For engineers, over the picture while F2 is on: how fast pictures come, how old they are, and what went wrong.
import { type JSX } from "preact";
import { fixed } from "../format/numbers";
import type { Run } from "../generated/protocol";
import { words } from "../words/language";
import type { Kiosk } from "./kiosk";
import { sourceText } from "./said";

export function Figures({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  return (
    <dl class="figures" aria-label={words.value.figures_title}>
      {rowsOf(kiosk).map(
        ([name, value]) =>
          value !== null && (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ),
      )}
    </dl>
  );
}

function rowsOf(kiosk: Kiosk): [string, string | null][] {
  const say = words.value;
  const { welcome, problem, run } = kiosk.state.value;
  const { live } = kiosk.shown.value;
  const camera = live?.camera;
  return [
    [say.figures_source, welcome && sourceText(welcome.source, say)],
    [say.figures_camera, camera?.name ?? null],
    [say.figures_sent, perSecond(camera?.fps)],
    [say.figures_judged, perSecond(kiosk.pace.rate)],
    [say.figures_waited, milliseconds(camera?.waited_ms)],
    [say.figures_trip, milliseconds(live?.round_trip_ms ?? kiosk.pace.roundTrip)],
    [say.figures_focal, run && focalText(run)],
    [say.figures_mapping, run && mappingText(run)],
    [say.figures_problem, problem && `${problem.code}: ${problem.detail}`],
  ];
}

function focalText({ estimate, promised }: Run): string | null {
  const fx = estimate?.parameters["fx"];
  const parts = [
    fx === undefined ? "" : `${fixed(fx, 2)} ± ${fixed(estimate?.sd["fx"] ?? 0, 3)} px`,
    promised === null ? "" : words.value.figures_promised(`± ${fixed(promised.fx_px, 3)} px`),
  ];
  return parts.filter((part) => part !== "").join(", ") || null;
}

function mappingText({ estimate }: Run): string | null {
  if (estimate?.mapping_mean_px == null || estimate.mapping_worst_px === null) return null;
  const px = (value: number): string => `${fixed(value, 3)} px`;
  const { mapping_mean_px, mapping_worst_px, required_mapping_px } = estimate;
  return words.value.figures_mapping_of(px(mapping_mean_px), px(mapping_worst_px), px(required_mapping_px));
}

function perSecond(value: number | null | undefined): string | null {
  return typeof value === "number" ? words.value.figures_per_second(fixed(value, 1)) : null;
}

function milliseconds(value: number | null | undefined): string | null {
  return typeof value === "number" ? `${fixed(value, 0)} ms` : null;
}
