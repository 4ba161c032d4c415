// The accuracy that a pose set promises before a board is lifted, and how the set was found.
import { type JSX } from "preact";
import type { PoseSet, Prediction } from "../generated/api";
import { fixed, percent, plain, significant, withUnit } from "../format/numbers";
import { exactly } from "../format/times";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { provenanceName } from "../words/measurements";
import { Facts, type Fact } from "./facts";

const PIXEL_PARAMETERS = new Set(["fx", "fy", "cx", "cy"]);

interface Props {
  set: PoseSet;
  /** Parameters of the nominal camera. */
  nominal: Readonly<Record<string, number>>;
  /** The SKU's corner noise, px: what sets were reckoned with that do not tell their own. */
  cornerNoise: number;
}

export function PredictionPanel({ set, nominal, cornerNoise }: Props): JSX.Element {
  const say = words.value;
  const { prediction } = set;
  return (
    <div class="column">
      {prediction !== null && (
        <section class="panel" aria-labelledby="prediction-title">
          <div class="panel-head">
            <h2 id="prediction-title">{say.prediction_title}</h2>
            <span class="muted">{say.prediction_note(noiseOf(set, cornerNoise))}</span>
          </div>
          <table class="intrinsics">
            <thead>
              <tr>
                <th scope="col">{say.col_parameter}</th>
                <th scope="col" class="number">
                  {say.nominal_value}
                </th>
                <th scope="col" class="number">
                  ± {say.col_sd}
                </th>
                <th scope="col">
                  <span class="visually-hidden">px</span>
                </th>
              </tr>
            </thead>
            <tbody>
              {Object.entries(prediction.sd).map(([name, sd]) => (
                <tr key={name}>
                  <th scope="row">
                    <var>{name}</var>
                  </th>
                  <td class="number muted">{plain(nominal[name] ?? 0)}</td>
                  <td class="number estimate">{sd === 0 ? say.fixed : `± ${significant(sd)}`}</td>
                  <td class="muted">{PIXEL_PARAMETERS.has(name) ? "px" : ""}</td>
                </tr>
              ))}
            </tbody>
          </table>
          <Facts facts={promised(prediction, say)} />
        </section>
      )}
      <section class="panel" aria-labelledby="provenance-title">
        <div class="panel-head">
          <h2 id="provenance-title">{say.provenance_title}</h2>
        </div>
        <Facts facts={origin(set, say)} />
      </section>
    </div>
  );
}

/** The noise that the planner reckoned with: from the best to the worst pose, or one for all. */
function noiseOf(set: PoseSet, cornerNoise: number): string {
  const each = set.prediction?.pose_sigma_px ?? [];
  const [least, most] = [Math.min(...each), Math.max(...each)];
  if (each.length > 0 && least < most) return `${significant(least)}–${significant(most)}`;
  const told = set.provenance["sigma_px"];
  return plain(each[0] ?? (typeof told === "number" ? told : cornerNoise));
}

function promised({ mapping, norm_px, condition, diversity }: Prediction, say: Words): Fact[] {
  return [
    {
      name: say.fact_mapping_planned,
      note: say.mean_and_worst,
      value: `${fixed(mapping.mean_px, 3)} / ${fixed(mapping.worst_px, 3)} px`,
    },
    { name: say.fact_norm, note: say.fact_norm_note, value: withUnit(fixed(norm_px, 3), "px") },
    { name: say.fact_condition, value: significant(condition) },
    { name: say.fact_coverage, value: percent(diversity.coverage) },
    {
      name: say.fact_spread,
      value: `${fixed(diversity.pitch_spread_deg, 0)}° / ${fixed(diversity.yaw_spread_deg, 0)}°`,
    },
    { name: say.fact_distance_ratio, value: `1 : ${fixed(diversity.distance_ratio, 2)}` },
  ];
}

function origin(set: PoseSet, say: Words): Fact[] {
  return [
    ...Object.entries(set.provenance).map(([name, value]) => ({
      name: provenanceName(name, say),
      value: provenanceText(value),
    })),
    { name: say.col_created, value: exactly(set.created_at) },
    ...(set.published_at === null ? [] : [{ name: say.set_published, value: exactly(set.published_at) }]),
    ...(set.retired_at === null ? [] : [{ name: say.state_retired, value: exactly(set.retired_at) }]),
    { name: "Id", value: set.id },
  ];
}

function provenanceText(value: unknown): string {
  if (typeof value === "string") return value;
  if (typeof value === "number") return plain(value);
  if (Array.isArray(value)) return value.map(provenanceText).join(", ");
  if (typeof value !== "object" || value === null) return JSON.stringify(value);
  return Object.entries(value)
    .map(([name, part]) => `${provenanceName(name, words.value)} ${provenanceText(part)}`)
    .join(" · ");
}
