// All pose sets of a SKU with what each promises; one is chosen by its link.
import { type JSX } from "preact";
import type { PoseSetSummary } from "../generated/api";
import { fixed, withUnit } from "../format/numbers";
import { when } from "../format/times";
import { words } from "../words/language";
import { PoseSetUpload } from "./pose_set_upload";
import { PublicationTag } from "./publication_tag";
import { addressOf } from "./route";

interface Props {
  code: string;
  poseSets: readonly PoseSetSummary[];
  chosen: string;
  /** The revision that an uploaded set is for. */
  revision: number;
}

export function PoseSetsPanel({ code, poseSets, chosen, revision }: Props): JSX.Element {
  const say = words.value;
  return (
    <section class="panel" aria-labelledby="pose-sets-title">
      <div class="panel-head">
        <h2 id="pose-sets-title">{say.pose_sets_title}</h2>
        <span class="muted">{poseSets.length}</span>
      </div>
      {poseSets.length === 0 ? (
        <p class="panel-body muted">{say.pose_sets_none}</p>
      ) : (
        <table class="runs pose-sets">
          <thead>
            <tr>
              <th scope="col">{say.col_created}</th>
              <th scope="col">{say.col_state}</th>
              <th scope="col" class="number">
                {say.col_poses}
              </th>
              <th scope="col" class="number">
                {say.fact_mapping_short}
              </th>
            </tr>
          </thead>
          <tbody>
            {poseSets.map((set) => (
              <tr key={set.id} class={set.id === chosen ? "chosen" : ""}>
                <th scope="row">
                  <a
                    class="row-link"
                    href={addressOf({ page: "sku", code, poseSet: set.id })}
                    aria-current={set.id === chosen ? "true" : undefined}
                  >
                    {when(set.created_at)}
                  </a>
                </th>
                <td>
                  <PublicationTag state={set.state} />{" "}
                  <span class="muted">{say.sku_revision(set.sku.revision)}</span>
                </td>
                <td class="number">{set.pose_count > 0 ? set.pose_count : "–"}</td>
                <td class="number">{withUnit(fixed(set.prediction?.mapping.mean_px, 3), "px")}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      <PoseSetUpload code={code} revision={revision} />
    </section>
  );
}
