// The parameters of two runs beside each other, with their difference in standard deviations of both.
import { type JSX } from "preact";
import type { ComparedParameter, Result, RunComparison } from "../generated/api";
import { digitsForSd, fixed, signed } from "../format/numbers";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { WideTable } from "./wide_table";

/** Bars of the difference end here. */
const MOST_SD = 5;

interface Props {
  comparison: RunComparison;
  a: Result;
  b: Result;
}

export function ComparedParameters({ comparison, a, b }: Props): JSX.Element {
  const say = words.value;
  const { parameters, distance_sd } = comparison;
  return (
    <section class="panel" aria-labelledby="parameters-title">
      <div class="panel-head">
        <h2 id="parameters-title">{say.intrinsics_title}</h2>
        {distance_sd !== null && <span class="muted">{say.pair_distance(fixed(distance_sd, 2))}</span>}
      </div>
      <WideTable label={say.intrinsics_title}>
        <table class="compare parameters-compared">
          <thead>
            <tr>
              <th scope="col">{say.col_parameter}</th>
              <th scope="col" class="number">
                A
              </th>
              <th scope="col" class="number">
                B
              </th>
              <th scope="col" class="number">
                B − A
              </th>
              <th scope="col" class="number">
                {say.pair_in_sd}
              </th>
              <th scope="col" aria-hidden="true" />
            </tr>
          </thead>
          <tbody>
            {parameters.map((one) => (
              <Row key={one.name} one={one} sdA={a.sd[one.name]} sdB={b.sd[one.name]} say={say} />
            ))}
          </tbody>
        </table>
      </WideTable>
    </section>
  );
}

interface RowProps {
  one: ComparedParameter;
  sdA: number | null | undefined;
  sdB: number | null | undefined;
  say: Words;
}

function Row({ one, sdA, sdB, say }: RowProps): JSX.Element {
  const digits = Math.max(digitsForSd(sdA), digitsForSd(sdB));
  return (
    <tr>
      <th scope="row">
        <var>{one.name}</var>
      </th>
      <Estimate value={one.a} sd={sdA} digits={digits} say={say} />
      <Estimate value={one.b} sd={sdB} digits={digits} say={say} />
      <td class="number estimate">{signed(one.difference, digits)}</td>
      <td class="number">{one.apart_sd === null ? say.fixed : signed(one.apart_sd, 1)}</td>
      <td class="bar-column" aria-hidden="true">
        {one.apart_sd !== null && <SdBar apart={one.apart_sd} />}
      </td>
    </tr>
  );
}

function Estimate({
  value,
  sd,
  digits,
  say,
}: Pick<RowProps, "say"> & { value: number; sd: number | null | undefined; digits: number }): JSX.Element {
  return (
    <td class="number">
      {fixed(value, digits)} <small class="muted">{sd === 0 ? say.fixed : `± ${fixed(sd, digits)}`}</small>
    </td>
  );
}

/** From the middle to either side; the marks are at one sd, where chance puts two of three. */
function SdBar({ apart }: { apart: number }): JSX.Element {
  const scale = 50 / MOST_SD;
  const length = Math.min(Math.abs(apart), MOST_SD) * scale;
  return (
    <svg class="sd-bar" viewBox="0 0 100 14" preserveAspectRatio="none">
      <rect class="margin-ground" x="0" y="4" width="100" height="6" />
      <rect class="sd-bar-value" x={apart < 0 ? 50 - length : 50} y="4" width={length} height="6" />
      {[-1, 0, 1].map((sd) => (
        <rect
          key={sd}
          class="margin-limit"
          x={50 + sd * scale - 0.5}
          y={sd === 0 ? 0 : 2}
          width="1"
          height={sd === 0 ? 14 : 10}
        />
      ))}
    </svg>
  );
}
