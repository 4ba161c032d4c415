// What a SKU's revision says about its camera and board.
import { type JSX } from "preact";
import type { SkuDocument } from "../generated/api";
import { plain, withUnit } from "../format/numbers";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { Facts, type Fact } from "./facts";

const PIXEL_PARAMETERS = new Set(["fx", "fy", "cx", "cy"]);

export function NominalPanel({ document }: { document: SkuDocument }): JSX.Element {
  const say = words.value;
  const fixed = new Set(document.fixed ?? []);
  return (
    <section class="panel" aria-labelledby="nominal-title">
      <div class="panel-head">
        <h2 id="nominal-title">{say.nominal_title}</h2>
        <span class="muted">{document.lens}</span>
      </div>
      <table class="intrinsics">
        <thead>
          <tr>
            <th scope="col">{say.col_parameter}</th>
            <th scope="col" class="number">
              {say.nominal_value}
            </th>
            <th scope="col">
              <span class="visually-hidden">px</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {Object.entries(document.nominal ?? {}).map(([name, value]) => (
            <tr key={name}>
              <th scope="row">
                <var>{name}</var>
              </th>
              <td class="number estimate">{plain(value)}</td>
              <td class="muted">
                {PIXEL_PARAMETERS.has(name) ? "px" : ""} {fixed.has(name) ? say.fixed : ""}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      <Facts facts={factsOf(document, say)} />
    </section>
  );
}

function factsOf(document: SkuDocument, say: Words): Fact[] {
  const space = document.pose_space ?? {};
  const range = (name: string, bounds: [number, number] | null | undefined, unit: string): Fact[] =>
    bounds ? [{ name, value: `${plain(bounds[0])} … ${plain(bounds[1])} ${unit}` }] : [];
  return [
    { name: say.fact_image_size, value: document.image_size.join(" × ") },
    { name: say.fact_target, value: document.target },
    { name: say.fact_corner_noise, value: withUnit(plain(document.corner_noise_px ?? 0.1), "px") },
    { name: say.fact_pose_count, value: plain(document.pose_count ?? 12) },
    ...range(say.fact_distance, space.distance_m, "m"),
    ...range(say.fact_yaw, space.yaw_deg, "°"),
    ...range(say.fact_pitch, space.pitch_deg, "°"),
    ...range(say.fact_roll, space.roll_deg, "°"),
  ];
}
