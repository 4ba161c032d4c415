// All poses of the run as small pictures of their outlines: taken, asked for now, to come.
import { type JSX } from "preact";
import type { Run, WantedPose } from "../generated/protocol";
import { words } from "../words/language";

/** Up to so many have room for larger pictures. */
const FEW = 12;

interface Props {
  run: Run;
  isMirrored: boolean;
  onRetake: (pose_index: number) => void;
}

export function PoseTiles({ run, isMirrored, onRetake }: Props): JSX.Element {
  return (
    <ol class={`tiles ${run.poses.length <= FEW ? "tiles-few" : ""}`} aria-label={words.value.guide_poses}>
      {run.poses.map((pose, i) => (
        <Tile
          key={pose.pose_index}
          pose={pose}
          number={i + 1}
          imageSize={run.image_size}
          isTaken={run.captured.includes(pose.pose_index)}
          isNow={run.pose_index === pose.pose_index}
          isMirrored={isMirrored}
          onRetake={onRetake}
        />
      ))}
    </ol>
  );
}

interface TileProps {
  pose: WantedPose;
  number: number;
  imageSize: [number, number];
  isTaken: boolean;
  isNow: boolean;
  isMirrored: boolean;
  onRetake: (pose_index: number) => void;
}

function Tile({ pose, number, imageSize, isTaken, isNow, isMirrored, onRetake }: TileProps): JSX.Element {
  const say = words.value;
  const [width, height] = imageSize;
  const label = isTaken
    ? say.guide_pose_taken(number)
    : isNow
      ? say.guide_pose_now(number)
      : say.guide_pose(number);
  const kind = isTaken ? "taken" : isNow ? "now" : "open";
  return (
    <li>
      <button
        type="button"
        class={`tile tile-${kind}`}
        aria-label={label}
        aria-current={isNow ? "step" : undefined}
        disabled={!isTaken}
        onClick={() => onRetake(pose.pose_index)}
      >
        <svg viewBox={`0 0 ${width} ${height}`} aria-hidden="true">
          <polygon
            points={pose.outline.map(([u, v]) => `${isMirrored ? width - u : u},${v}`).join(" ")}
            vector-effect="non-scaling-stroke"
          />
        </svg>
        <span class="tile-number">{isTaken ? "✓" : number}</span>
      </button>
    </li>
  );
}
