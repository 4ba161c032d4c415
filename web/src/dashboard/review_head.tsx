// The head of a review: which set, who published and retired it when, and which other one to compare it with.
import { type JSX } from "preact";
import { useId } from "preact/hooks";
import type { PoseSet, PoseSetSummary } from "../generated/api";
import { when } from "../format/times";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { PublicationTag } from "./publication_tag";
import { ReviewActions } from "./review_actions";
import { addressOf } from "./route";

interface Props {
  set: PoseSet;
  others: readonly PoseSetSummary[];
  onChange: (set: PoseSet) => void;
}

export function ReviewHead({ set, others, onChange }: Props): JSX.Element {
  const say = words.value;
  return (
    <>
      <div class="page-head">
        <h1>
          {say.review_title} · {set.sku.code}
        </h1>
        <span class="muted">
          {say.sku_revision(set.sku.revision)} · {say.sku_poses(set.poses.length)} · {say.col_created}{" "}
          {when(set.created_at)}
        </span>
        <Publishing set={set} />
        <nav class="page-links" aria-label={set.sku.code}>
          <a href={addressOf({ page: "sku", code: set.sku.code, poseSet: set.id })}>
            {say.review_back(set.sku.code)}
          </a>
        </nav>
      </div>
      <div class="review-bar">
        <ReviewActions set={set} onChange={onChange} />
        <CompareChoice id={set.id} others={others} chosen="" />
      </div>
    </>
  );
}

export function Publishing({ set }: { set: PoseSet }): JSX.Element {
  const say = words.value;
  return (
    <span class="publishing">
      <PublicationTag state={set.state} />
      <span class="muted">{historyOf(set, say).join(" · ")}</span>
    </span>
  );
}

function historyOf(set: PoseSet, say: Words): string[] {
  return [
    ...(set.published_at === null
      ? []
      : [say.review_published(when(set.published_at), set.published_by ?? say.review_unknown_who)]),
    ...(set.retired_at === null
      ? []
      : [say.review_retired(when(set.retired_at), set.retired_by ?? say.review_unknown_who)]),
  ];
}

interface ChoiceProps {
  /** The set that is compared. */
  id: string;
  others: readonly PoseSetSummary[];
  /** The set it is compared with now; empty for none. */
  chosen: string;
}

export function CompareChoice({ id, others, chosen }: ChoiceProps): JSX.Element {
  const say = words.value;
  const field = useId();
  const compare = (other: string): void => {
    window.location.hash = addressOf({ page: "poseSet", id, with: other });
  };
  return (
    <span class="choice">
      <label for={field}>{say.compare_with}</label>
      <select
        id={field}
        value={chosen}
        disabled={others.length === 0}
        onChange={(event) => compare(event.currentTarget.value)}
      >
        <option value="">{say.compare_nothing}</option>
        {others.map((other) => (
          <option key={other.id} value={other.id}>
            {nameOf(other, say)}
          </option>
        ))}
      </select>
    </span>
  );
}

/** Enough to tell sets of one SKU apart: when, how many poses, revision and state. */
function nameOf(set: PoseSetSummary, say: Words): string {
  const state = { draft: say.state_draft, published: say.state_published, retired: say.state_retired };
  return [
    when(set.created_at),
    say.sku_poses(set.pose_count),
    say.sku_revision(set.sku.revision),
    state[set.state],
    set.id.slice(-6),
  ].join(" · ");
}
