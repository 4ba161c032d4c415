// A pose set under review: why these poses, and what they promise; or two sets of one SKU beside each other.
import { type JSX } from "preact";
import { useCallback, useState } from "preact/hooks";
import { allParts } from "../api/all_parts";
import { getPoseSet, getPoseSets, getReview } from "../api/client";
import { useResource } from "../api/use_resource";
import type { PoseSet, PoseSetReview, PoseSetSummary } from "../generated/api";
import { Loading, ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { ReviewComparison } from "./review_comparison";
import { ReviewHead } from "./review_head";
import { ReviewSingle } from "./review_single";
import { useTitle } from "./use_title";

const REFRESH_MS = 2000;

export interface Reviewed {
  set: PoseSet;
  /** Null as long as it is planned. */
  review: PoseSetReview | null;
}

interface Loaded extends Reviewed {
  other: Reviewed | null;
  others: readonly PoseSetSummary[];
}

/** A set with poses never changes but for its state; one that is still planned does. */
const whilePlanned = ({ set }: Loaded): number | null => (set.poses.length === 0 ? REFRESH_MS : null);

async function loadOne(id: string, signal: AbortSignal): Promise<Reviewed> {
  const set = await getPoseSet(id, signal);
  return { set, review: set.poses.length === 0 ? null : await getReview(id, signal) };
}

async function load(id: string, other: string, signal: AbortSignal): Promise<Loaded> {
  const [one, two] = await Promise.all([
    loadOne(id, signal),
    other === "" || other === id ? null : loadOne(other, signal),
  ]);
  const sets = await allParts((cursor) => getPoseSets(one.set.sku.code, cursor, signal));
  return { ...one, other: two, others: sets.filter((set) => set.id !== id && set.pose_count > 0) };
}

export function ReviewPage({ id, other }: { id: string; other: string }): JSX.Element {
  const say = words.value;
  const found = useResource(
    useCallback((signal: AbortSignal) => load(id, other, signal), [id, other]),
    whilePlanned,
  );
  const code = found.state === "ready" ? found.value.set.sku.code : "";
  useTitle(`${say.review_title} ${code}`.trim());
  // What a press on this page made of a set counts until the page is left.
  const [changed, setChanged] = useState<PoseSet | null>(null);
  if (found.state === "loading") return <Loading />;
  if (found.state === "failed") return <ProblemNotice problem={found.problem} />;
  const { review, other: second, others } = found.value;
  const set = changed?.id === id ? changed : found.value.set;
  if (review !== null && second !== null && second.review !== null) {
    return (
      <ReviewComparison a={{ set, review }} b={{ set: second.set, review: second.review }} others={others} />
    );
  }
  return (
    <>
      <ReviewHead set={set} others={others} onChange={setChanged} />
      {review === null ? (
        <p class="panel panel-body muted">{say.pose_set_planning}</p>
      ) : (
        <ReviewSingle key={id} set={set} review={review} />
      )}
    </>
  );
}
