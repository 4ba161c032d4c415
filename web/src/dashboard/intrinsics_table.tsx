// The estimate with its uncertainty: as many digits as the sd allows, and what it means over the image.
import { type JSX } from "preact";
import type { Result } from "../generated/api";
import { digitsForSd, fixed, significant, withUnit } from "../format/numbers";
import type { Words } from "../words/en";
import { words } from "../words/language";
import { EstimateTable } from "./estimate_table";
import { Facts, type Fact } from "./facts";

const PIXEL_PARAMETERS = new Set(["fx", "fy", "cx", "cy"]);

export function IntrinsicsTable({ result }: { result: Result }): JSX.Element {
  const say = words.value;
  return (
    <section class="panel intrinsics-panel" aria-labelledby="intrinsics-title">
      <div class="panel-head">
        <h2 id="intrinsics-title">{say.intrinsics_title}</h2>
        <span class="muted">{result.lens}</span>
      </div>
      <EstimateTable caption={say.intrinsics_caption} unit="px">
        {Object.entries(result.intrinsics).map(([name, value]) => (
          <Parameter key={name} name={name} value={value} sd={result.sd[name]} say={say} />
        ))}
      </EstimateTable>
      <Facts facts={factsOf(result, say)} />
    </section>
  );
}

interface ParameterProps {
  name: string;
  value: number;
  sd: number | null | undefined;
  say: Words;
}

function Parameter({ name, value, sd, say }: ParameterProps): JSX.Element {
  const digits = digitsForSd(sd);
  const isFixed = sd === 0;
  return (
    <tr>
      <th scope="row">
        <var>{name}</var>
      </th>
      <td class="number estimate">{fixed(value, digits)}</td>
      <td class="number">{isFixed ? say.fixed : `± ${fixed(sd, digits)}`}</td>
      <td class="muted">{PIXEL_PARAMETERS.has(name) ? "px" : ""}</td>
    </tr>
  );
}

function factsOf(result: Result, say: Words): Fact[] {
  const { mapping } = result;
  const pair = (mean: number | null, worst: number | null): string =>
    `${fixed(mean, 3)} / ${fixed(worst, 3)} px`;
  return [
    { name: say.fact_rms, value: withUnit(fixed(result.rms_px, 4), "px") },
    { name: say.fact_sigma, value: withUnit(fixed(result.sigma_px, 4), "px") },
    {
      name: say.fact_mapping,
      note: say.mean_and_worst,
      value: pair(mapping.zone_mean_px, mapping.zone_worst_px),
    },
    {
      name: say.fact_mapping_valid,
      note: say.mean_and_worst,
      value: pair(mapping.valid_mean_px, mapping.valid_worst_px),
    },
    { name: say.fact_agreement, value: withUnit(significant(result.agreement_px), "px") },
    ...(result.score === null ? [] : [{ name: say.fact_score, value: significant(result.score) }]),
    { name: say.fact_image_size, value: result.image_size.join(" × ") },
    {
      name: say.versions,
      value: Object.entries(result.versions)
        .map((pair) => pair.join(" "))
        .join(", "),
    },
  ];
}
