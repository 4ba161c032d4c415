// What a pose set comes to in a few figures: what it promises against its limits, and what varies in it.
import { type JSX } from "preact";
import type { PoseSet, PoseSetReview } from "../generated/api";
import { fixed, percent, plain, significant, withUnit } from "../format/numbers";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { spreadOf } from "./review_sums";

interface Figure {
  name: string;
  value: string;
  note: string;
  /** Whether the value is within its limit; null where it has none. */
  holds: boolean | null;
}

export function ReviewFigures({ set, review }: { set: PoseSet; review: PoseSetReview }): JSX.Element {
  const say = words.value;
  return (
    <section class="panel figures review-figures" aria-label={say.review_figures}>
      {figuresOf(set, review, say).map(({ name, value, note, holds }) => (
        <div key={name}>
          <span class="figure-name">{name}</span>
          <span class={`figure-value ${holds === null ? "" : holds ? "figure-holds" : "figure-fails"}`}>
            {value}
          </span>
          <span class="muted">{note}</span>
        </div>
      ))}
    </section>
  );
}

function figuresOf(set: PoseSet, review: PoseSetReview, say: Words): Figure[] {
  const { working_zone: working, valid_region: valid } = review;
  const pitch = spreadOf(review.poses.map(({ pitch_deg }) => pitch_deg));
  const yaw = spreadOf(review.poses.map(({ yaw_deg }) => yaw_deg));
  const distance = spreadOf(review.poses.map(({ distance_m }) => distance_m));
  const smallest = set.prediction?.smallest_count ?? null;
  const px = (value: number | null): string => withUnit(significant(value), "px");
  const limit = (value: number): string => `${plain(value)} px`;
  return [
    {
      name: say.review_zone_error,
      value: px(working.mean_px),
      note: `${say.review_zone_note(px(working.worst_px), limit(review.working_limit_px))} · ${margin(working.mean_px, review.working_limit_px, say)}`,
      holds: working.mean_px !== null && working.mean_px <= review.working_limit_px,
    },
    {
      name: say.review_valid_error,
      value: px(valid.worst_px),
      note: `${say.review_valid_note(limit(review.valid_limit_px))} · ${margin(valid.worst_px, review.valid_limit_px, say)}`,
      holds: valid.worst_px !== null && valid.worst_px <= review.valid_limit_px,
    },
    {
      name: say.review_poses,
      value: String(review.poses.length),
      note: smallest === null ? "" : say.review_poses_note(smallest),
      holds: null,
    },
    {
      name: say.review_covered,
      value: percent(working.covered_share),
      note: say.review_covered_note(percent(valid.covered_share)),
      holds: null,
    },
    {
      name: say.review_tilts,
      value: `${degrees(pitch)} / ${degrees(yaw)}`,
      note: say.review_tilts_note,
      holds: null,
    },
    {
      name: say.review_distances,
      value: `${fixed(distance.least, 2)}–${fixed(distance.most, 2)} m`,
      note: say.review_distances_note(fixed(distance.most / distance.least, 1)),
      holds: null,
    },
    {
      name: say.review_norm,
      value: px(set.prediction?.norm_px ?? null),
      note: say.fact_norm_note,
      holds: null,
    },
  ];
}

function margin(value: number | null, limit: number, say: Words): string {
  if (value === null || value > limit) return say.review_above_limit;
  return say.review_margin(fixed(limit / value, limit / value < 10 ? 1 : 0));
}

function degrees({ least, most }: { least: number; most: number }): string {
  return `${fixed(least, 0)}…${fixed(most, 0)}°`;
}
