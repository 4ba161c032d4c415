// A pose set: its poses drawn in the camera's image, one picked out; what the set promises; where it comes from.
import { type JSX } from "preact";
import { useCallback, useMemo, useState } from "preact/hooks";
import { getPoseSet } from "../api/client";
import { useResource } from "../api/use_resource";
import { outlinesOf } from "../drawing/pose_outlines";
import type { PoseSet, SkuDocument } from "../generated/api";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { PoseSetPicture } from "./pose_set_picture";
import { PosesTable } from "./poses_table";
import { PredictionPanel } from "./prediction_panel";
import { PublicationTag } from "./publication_tag";
import { addressOf } from "./route";

const REFRESH_MS = 2000;
/** A set with poses never changes but for its state; one that is still planned does. */
const whilePlanned = (set: PoseSet): number | null => (set.poses.length === 0 ? REFRESH_MS : null);

export function PoseSetView({ id, document }: { id: string; document: SkuDocument }): JSX.Element {
  const found = useResource(
    useCallback((signal: AbortSignal) => getPoseSet(id, signal), [id]),
    whilePlanned,
  );
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  return <Poses set={found.value} document={document} />;
}

function Poses({ set, document }: { set: PoseSet; document: SkuDocument }): JSX.Element {
  const say = words.value;
  const outlines = useMemo(() => outlinesOf(set.poses), [set.poses]);
  const [chosen, setChosen] = useState(0);
  if (set.poses.length === 0) return <p class="panel panel-body muted">{say.pose_set_planning}</p>;
  return (
    <div class="columns columns-gates">
      <section class="panel" aria-labelledby="pose-set-title">
        <div class="panel-head">
          <h2 id="pose-set-title">{say.pose_set_title}</h2>
          <span class="muted">
            {say.sku_poses(set.poses.length)} · <PublicationTag state={set.state} />
          </span>
          <a href={addressOf({ page: "poseSet", id: set.id, with: "" })}>{say.review_open}</a>
        </div>
        <PoseSetPicture
          outlines={outlines}
          chosen={chosen}
          imageSize={document.image_size}
          onChoose={setChosen}
        />
        <PosesTable poses={set.poses} chosen={chosen} onChoose={setChosen} />
      </section>
      <PredictionPanel
        set={set}
        nominal={document.nominal ?? {}}
        cornerNoise={document.corner_noise_px ?? 0.1}
      />
    </div>
  );
}
