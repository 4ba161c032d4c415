// Where the camera is in the vehicle, with its uncertainty and what that comes from; nothing without such a result.
import { type JSX } from "preact";
import type { Extrinsics, Result, WorstSd } from "../generated/api";
import { digitsForSd, fixed, withUnit } from "../format/numbers";
import type { Words } from "../words/en";
import { words } from "../words/language";
import { EstimateTable } from "./estimate_table";
import { Facts, type Fact } from "./facts";

const AXES = ["x", "y", "z"] as const;

export function ExtrinsicsPanel({ result }: { result: Result }): JSX.Element | null {
  const say = words.value;
  const { extrinsics } = result;
  if (extrinsics === null) return null;
  return (
    <section class="panel" aria-labelledby="extrinsics-title">
      <div class="panel-head">
        <h2 id="extrinsics-title">{say.extrinsics_title}</h2>
        <span class="muted">T_vehicle_cam</span>
      </div>
      <ExtrinsicsBody extrinsics={extrinsics} />
    </section>
  );
}

/** The estimate with what its uncertainty comes from. */
export function ExtrinsicsBody({ extrinsics }: { extrinsics: Extrinsics }): JSX.Element {
  const say = words.value;
  return (
    <>
      <EstimateTable caption={say.extrinsics_caption} unit="mm">
        {AXES.map((axis, i) => (
          <Row
            key={axis}
            name={`${say.extrinsics_position} ${axis}`}
            value={1000 * (extrinsics.pose.tvec[i] ?? 0)}
            sd={extrinsics.translation_sd_mm[i]}
            unit="mm"
          />
        ))}
        {AXES.map((axis, i) => (
          <Row
            key={`turn-${axis}`}
            name={`${say.extrinsics_rotation} ${axis}`}
            value={((extrinsics.pose.rvec[i] ?? 0) * 180) / Math.PI}
            sd={(extrinsics.rotation_sd_mdeg[i] ?? 0) / 1000}
            unit="°"
          />
        ))}
      </EstimateTable>
      <Facts facts={factsOf(extrinsics, say)} />
    </>
  );
}

interface RowProps {
  name: string;
  value: number;
  sd: number | undefined;
  unit: string;
}

function Row({ name, value, sd, unit }: RowProps): JSX.Element {
  const digits = digitsForSd(sd);
  return (
    <tr>
      <th scope="row">{name}</th>
      <td class="number estimate">{fixed(value, digits)}</td>
      <td class="number">± {fixed(sd ?? null, digits)}</td>
      <td class="muted">{unit}</td>
    </tr>
  );
}

function factsOf({ parts, rms_px, fixture, views }: Extrinsics, say: Words): Fact[] {
  const sources = [parts.noise, parts.intrinsics, parts.fixture];
  const all = (value: (part: WorstSd) => number, digits: number): string =>
    sources.map((part) => fixed(value(part), digits)).join(" / ");
  return [
    { name: say.extrinsics_parts, value: `${all((part) => part.translation_sd_mm, 3)} mm` },
    { name: "", value: `${all((part) => part.rotation_sd_mdeg, 1)} mdeg` },
    { name: say.fact_rms, value: withUnit(fixed(rms_px, 4), "px") },
    { name: say.extrinsics_target, value: `${fixture.target} × ${views.length}` },
  ];
}
