// Two pose sets of one SKU beside each other: figures with ratios, both images, maps on one scale, one chart.
import { type JSX } from "preact";
import { useMemo, useState } from "preact/hooks";
import { boundOutlines } from "../drawing/pose_outlines";
import type { PoseSet, PoseSetReview, PoseSetSummary } from "../generated/api";
import { when } from "../format/times";
import { words } from "../words/language";
import { CompareTable } from "./compare_table";
import { CountPanel } from "./count_panel";
import { CoveragePanel, ErrorPanel } from "./heat_panels";
import { PoseSetPicture } from "./pose_set_picture";
import { CompareChoice, Publishing } from "./review_head";
import { addressOf } from "./route";

export interface Side {
  set: PoseSet;
  review: PoseSetReview;
}

const NAMES = ["A", "B"] as const;

interface Props {
  a: Side;
  b: Side;
  /** Sets of the SKU that the first one can be compared with. */
  others: readonly PoseSetSummary[];
}

export function ReviewComparison({ a, b, others }: Props): JSX.Element {
  const say = words.value;
  const reviews = useMemo(() => [a.review, b.review], [a.review, b.review]);
  const sets = useMemo(
    () => [
      { name: NAMES[0], set: a.set },
      { name: NAMES[1], set: b.set },
    ],
    [a.set, b.set],
  );
  return (
    <>
      <div class="page-head">
        <h1>
          {say.compare_title} · {a.set.sku.code}
        </h1>
        <CompareChoice id={a.set.id} others={others} chosen={b.set.id} />
        <nav class="page-links" aria-label={say.compare_title}>
          <a href={addressOf({ page: "poseSet", id: b.set.id, with: a.set.id })}>B ⇄ A</a>
          <a href={addressOf({ page: "poseSet", id: a.set.id, with: "" })}>{say.compare_end}</a>
        </nav>
      </div>
      {a.set.sku.code !== b.set.sku.code && <p class="notice notice-problem">{say.compare_other_sku}</p>}
      <div class="columns columns-half">
        <SidePanel name={NAMES[0]} side={a} />
        <SidePanel name={NAMES[1]} side={b} />
      </div>
      <div class="columns columns-half">
        <CompareTable a={a} b={b} />
        <CountPanel sets={sets} />
      </div>
      <ErrorPanel reviews={reviews} names={NAMES} />
      <CoveragePanel reviews={reviews} names={NAMES} />
    </>
  );
}

function SidePanel({ name, side: { set, review } }: { name: string; side: Side }): JSX.Element {
  const say = words.value;
  const [chosen, setChosen] = useState(0);
  const [hovered, setHovered] = useState<number | null>(null);
  const outlines = useMemo(() => boundOutlines(review.poses.map(({ outline_px }) => outline_px)), [review]);
  return (
    <section class="panel" aria-label={name}>
      <div class="panel-head">
        <h2>
          <a href={addressOf({ page: "poseSet", id: set.id, with: "" })}>
            {name} · {say.sku_poses(set.poses.length)}
          </a>
        </h2>
        <span class="muted">
          {say.sku_revision(set.sku.revision)} · {when(set.created_at)}
        </span>
        <Publishing set={set} />
      </div>
      <PoseSetPicture
        outlines={outlines}
        chosen={chosen}
        hovered={hovered}
        imageSize={review.image_size}
        workingZone={review.working_zone}
        onChoose={setChosen}
        onHover={setHovered}
      />
    </section>
  );
}
