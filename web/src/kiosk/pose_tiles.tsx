// All poses of the run as small pictures of their outlines: taken, asked for now, to come.
import { type JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
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
  // A pose that another one stands in for is not asked for any more.
  const replaced = new Set(run.poses.map((pose) => pose.replaces));
  const poses = run.poses.filter((p) => !replaced.has(p.pose_index) || run.captured.includes(p.pose_index));
  return (
    <ol class={`tiles ${poses.length <= FEW ? "tiles-few" : ""}`} aria-label={words.value.guide_poses}>
      {poses.map((pose) => (
        <Tile
          key={pose.pose_index}
          pose={pose}
          number={pose.pose_index + 1}
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
  const isAdded = pose.added_for !== null;
  const label = isTaken
    ? say.guide_pose_taken(number)
    : isAdded
      ? say.help_pose_added(number)
      : isNow
        ? say.guide_pose_now(number)
        : say.guide_pose(number);
  const kind = isTaken ? "taken" : isNow ? "now" : "open";
  const item = useRef<HTMLLIElement>(null);

  // Of many poses not all have room: the one that is asked for is always seen.
  useEffect(() => {
    if (isNow) item.current?.scrollIntoView({ block: "nearest" });
  }, [isNow]);
  return (
    <li ref={item}>
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
        <span class="tile-number">{isTaken ? "✓" : `${isAdded ? "+" : ""}${number}`}</span>
      </button>
    </li>
  );
}
