// The poses of a set as an engineer reads them: how far, how turned, and what the set loses without each.
import { type JSX } from "preact";
import type { ReviewedPose } from "../generated/api";
import { fixed, percent } from "../format/numbers";
import { words } from "../words/language";

interface Props {
  poses: readonly ReviewedPose[];
  chosen: number;
  hovered: number | null;
  onChoose: (index: number) => void;
  onHover: (index: number | null) => void;
}

export function ReviewPosesTable({ poses, chosen, hovered, onChoose, onHover }: Props): JSX.Element {
  const say = words.value;
  const most = Math.max(...poses.map(({ loss_share }) => loss_share ?? 0), 1e-9);
  return (
    <section class="panel" aria-labelledby="poses-title">
      <div class="panel-head">
        <h2 id="poses-title">{say.poses_list}</h2>
      </div>
      <div class="views wide-table">
        <table class="poses" onMouseLeave={() => onHover(null)}>
          <thead>
            <tr>
              <th scope="col">{say.col_pose}</th>
              {[say.col_distance, say.col_pitch, say.col_yaw, say.col_roll, say.col_square].map((name) => (
                <th key={name} scope="col" class="number">
                  {name}
                </th>
              ))}
              <th scope="col" colSpan={2}>
                {say.col_loss}
              </th>
            </tr>
          </thead>
          <tbody>
            {poses.map((pose) => (
              <tr
                key={pose.index}
                class={`${pose.index === chosen ? "chosen" : ""} ${pose.index === hovered ? "hovered" : ""}`}
                onMouseEnter={() => onHover(pose.index)}
              >
                <th scope="row">
                  <button
                    type="button"
                    class="row-link"
                    aria-pressed={pose.index === chosen}
                    aria-label={say.pose_number(pose.index + 1)}
                    onClick={() => onChoose(pose.index)}
                    onFocus={() => onHover(pose.index)}
                    onBlur={() => onHover(null)}
                  >
                    {pose.index + 1}
                  </button>
                </th>
                <td class="number">{fixed(1000 * pose.distance_m, 0)} mm</td>
                <td class="number">{fixed(pose.pitch_deg, 0)}°</td>
                <td class="number">{fixed(pose.yaw_deg, 0)}°</td>
                <td class="number">{fixed(pose.roll_deg, 0)}°</td>
                <td class="number">{fixed(pose.smallest_square_px, 0)} px</td>
                <td class="number">{lossText(pose.loss_share, say.loss_none)}</td>
                <td class="loss-cell">
                  <svg class="loss-bar" viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true">
                    <rect width={100 * ((pose.loss_share ?? most) / most)} height="10" />
                  </svg>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function lossText(share: number | null, none: string): string {
  if (share === null) return none;
  return share < 0.005 ? `+${fixed(100 * share, 1)} %` : `+${percent(share)}`;
}
