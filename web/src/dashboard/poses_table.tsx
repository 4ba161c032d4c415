// The poses in their order with what a hand would call them: where, how far, how much tilted.
import { type JSX } from "preact";
import type { PlannedPose } from "../generated/api";
import { fixed } from "../format/numbers";
import { words } from "../words/language";
import { boardTiltDeg } from "./view_pose";

interface Props {
  poses: readonly PlannedPose[];
  chosen: number;
  onChoose: (index: number) => void;
}

export function PosesTable({ poses, chosen, onChoose }: Props): JSX.Element {
  const say = words.value;
  return (
    <figure class="views">
      <table class="poses">
        <caption class="visually-hidden">{say.poses_caption}</caption>
        <thead>
          <tr>
            <th scope="col">{say.col_pose}</th>
            <th scope="col" class="number">
              x mm
            </th>
            <th scope="col" class="number">
              y mm
            </th>
            <th scope="col" class="number">
              z mm
            </th>
            <th scope="col" class="number">
              {say.fact_tilt}
            </th>
          </tr>
        </thead>
        <tbody>
          {poses.map((pose, i) => (
            <tr key={i} class={i === chosen ? "chosen" : ""}>
              <th scope="row">
                <button
                  type="button"
                  class="row-link"
                  aria-pressed={i === chosen}
                  aria-label={say.pose_number(i + 1)}
                  onClick={() => onChoose(i)}
                >
                  {i + 1}
                </button>
              </th>
              {pose.tvec.map((metres, axis) => (
                <td key={axis} class="number">
                  {fixed(1000 * metres, 0)}
                </td>
              ))}
              <td class="number">{fixed(boardTiltDeg(pose.rvec), 0)}°</td>
            </tr>
          ))}
        </tbody>
      </table>
    </figure>
  );
}
