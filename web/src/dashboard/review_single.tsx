// One pose set explained: figures, the poses in the image, in space and in a list, maps over the image, the curve.
import { type JSX } from "preact";
import { useMemo, useState } from "preact/hooks";
import { boundOutlines } from "../drawing/pose_outlines";
import type { PoseSet, PoseSetReview } from "../generated/api";
import { percent } from "../format/numbers";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { CountPanel } from "./count_panel";
import { CoveragePanel, ErrorPanel } from "./heat_panels";
import { PoseSetPicture } from "./pose_set_picture";
import { PredictionPanel } from "./prediction_panel";
import { ReviewFigures } from "./review_figures";
import { ReviewPosesTable } from "./review_poses_table";
import { strongestPose } from "./review_sums";
import { SpacePanel } from "./space_panel";

export function ReviewSingle({ set, review }: { set: PoseSet; review: PoseSetReview }): JSX.Element {
  const say = words.value;
  const [chosen, setChosen] = useState(0);
  const [hovered, setHovered] = useState<number | null>(null);
  const outlines = useMemo(() => boundOutlines(review.poses.map(({ outline_px }) => outline_px)), [review]);
  const reviews = useMemo(() => [review], [review]);
  const sets = useMemo(() => [{ name: "", set }], [set]);
  const picking = { chosen, hovered, onChoose: setChosen, onHover: setHovered };
  return (
    <>
      <ReviewFigures set={set} review={review} />
      <div class="columns columns-half">
        <section class="panel" aria-labelledby="image-title">
          <div class="panel-head">
            <h2 id="image-title">{say.review_in_image}</h2>
            <span class="muted">{strongest(review, say)}</span>
          </div>
          <PoseSetPicture
            outlines={outlines}
            imageSize={review.image_size}
            workingZone={review.working_zone}
            {...picking}
          />
        </section>
        <SpacePanel review={review} {...picking} />
        <ErrorPanel reviews={reviews} names={[]} />
        <CoveragePanel reviews={reviews} names={[]} />
      </div>
      <div class="columns columns-gates">
        <div class="column">
          <ReviewPosesTable poses={review.poses} {...picking} />
          <CountPanel sets={sets} />
        </div>
        <PredictionPanel set={set} nominal={review.nominal} cornerNoise={review.sigma_px[0] ?? 0} />
      </div>
    </>
  );
}

function strongest({ poses }: PoseSetReview, say: Words): string {
  const pose = strongestPose(poses);
  if (pose === undefined) return "";
  if (pose.loss_share === null) return say.review_needed(pose.index + 1);
  return say.review_strongest(pose.index + 1, percent(pose.loss_share));
}
