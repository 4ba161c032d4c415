// Under which conditions two runs came about, and what they came to; what differs is marked.
import { type JSX } from "preact";
import { fixed, significant, withUnit } from "../format/numbers";
import { exactly } from "../format/times";
import { standingOf } from "../shell/verdict_mark";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { purposeName } from "../words/measurements";
import { addressOf } from "./route";
import { SIDES, type Side } from "./run_comparison_page";
import { StandingTag } from "./runs_table";
import { WideTable } from "./wide_table";

interface Condition {
  name: string;
  of: (run: Side) => string;
  /** Two runs always differ in it, so that this tells nothing. */
  isOwn?: boolean;
}

export function ComparedConditions({ sides }: { sides: [Side, Side] }): JSX.Element {
  const say = words.value;
  return (
    <section class="panel" aria-labelledby="conditions-title">
      <div class="panel-head">
        <h2 id="conditions-title">{say.pair_conditions}</h2>
        <span class="muted">{say.pair_differs_key}</span>
      </div>
      <WideTable label={say.pair_conditions}>
        <table class="compare">
          <thead>
            <tr>
              <th scope="col">
                <span class="visually-hidden">{say.pair_conditions}</span>
              </th>
              {sides.map((run, i) => (
                <th key={SIDES[i]} scope="col">
                  {SIDES[i]} · <a href={addressOf({ page: "run", id: run.id, capture: "" })}>{run.serial}</a>
                </th>
              ))}
              <th scope="col" class="differs">
                <span class="visually-hidden">{say.pair_differs}</span>
                {sides[0].serial !== sides[1].serial && <span aria-hidden="true">≠</span>}
              </th>
            </tr>
          </thead>
          <tbody>
            <tr>
              <th scope="row">{say.col_verdict}</th>
              {sides.map((run, i) => (
                <td key={SIDES[i]}>
                  <StandingTag standing={standingOf(run)} />
                </td>
              ))}
              <Differs isSo={sides[0].verdict !== sides[1].verdict} say={say} />
            </tr>
            {conditionsOf(say).map(({ name, of, isOwn }) => (
              <tr key={name}>
                <th scope="row">{name}</th>
                {sides.map((run, i) => (
                  <td key={SIDES[i]}>{of(run)}</td>
                ))}
                <Differs isSo={isOwn !== true && of(sides[0]) !== of(sides[1])} say={say} />
              </tr>
            ))}
          </tbody>
        </table>
      </WideTable>
    </section>
  );
}

function Differs({ isSo, say }: { isSo: boolean; say: Words }): JSX.Element {
  return <td class="differs">{isSo && <span title={say.pair_differs}>≠</span>}</td>;
}

function conditionsOf(say: Words): Condition[] {
  return [
    { name: say.col_sku, of: ({ sku }) => `${sku.code} ${say.sku_revision(sku.revision)}` },
    { name: say.col_station, of: ({ station }) => station ?? "–" },
    { name: say.col_purpose, of: ({ purpose }) => purposeName(purpose, say) },
    { name: say.run_started, of: ({ created_at }) => exactly(created_at), isOwn: true },
    {
      name: say.col_captures,
      of: ({ captures, poses }) => (poses > 0 ? `${captures} / ${poses}` : String(captures)),
    },
    { name: say.pair_lens, of: ({ result }) => result?.lens ?? "–" },
    { name: say.fact_image_size, of: ({ result }) => result?.image_size.join(" × ") ?? "–" },
    { name: say.fact_rms, of: ({ result }) => withUnit(fixed(result?.rms_px, 4), "px"), isOwn: true },
    { name: say.fact_sigma, of: ({ result }) => withUnit(fixed(result?.sigma_px, 4), "px"), isOwn: true },
    { name: say.fact_score, of: ({ result }) => significant(result?.score), isOwn: true },
    {
      name: say.versions,
      of: ({ result }) =>
        Object.entries(result?.versions ?? {})
          .map((pair) => pair.join(" "))
          .join(", "),
    },
  ];
}
