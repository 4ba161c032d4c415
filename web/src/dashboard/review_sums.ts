// Figures out of a review: spreads, the pose that most rests on, two sets beside each other.
import type { PoseSet, PoseSetReview, ReviewedPose } from "../generated/api";

export interface Spread {
  least: number;
  most: number;
}

export function spreadOf(values: readonly number[]): Spread {
  return { least: Math.min(...values), most: Math.max(...values) };
}

/** The pose without which most is lost; one that cannot be spared at all comes first. */
export function strongestPose(poses: readonly ReviewedPose[]): ReviewedPose | undefined {
  const weight = ({ loss_share }: ReviewedPose): number => loss_share ?? Number.POSITIVE_INFINITY;
  return poses.reduce<ReviewedPose | undefined>(
    (best, pose) => (best === undefined || weight(pose) > weight(best) ? pose : best),
    undefined,
  );
}

export type FigureName =
  | "poses"
  | "zone_mean"
  | "zone_worst"
  | "valid_worst"
  | "norm"
  | "covered"
  | "pitch"
  | "yaw"
  | "nearest"
  | "farthest"
  | "square"
  | `sd_${string}`;

export interface ComparedFigure {
  name: FigureName;
  a: number | null;
  b: number | null;
  /** Whether a smaller value is the better one; null where neither is. */
  smallerIsBetter: boolean | null;
}

interface Side {
  set: PoseSet;
  review: PoseSetReview;
}

/** The figures of two sets, in the order of a table. */
export function compareFigures(a: Side, b: Side): ComparedFigure[] {
  const figure = (
    name: FigureName,
    of: (side: Side) => number | null,
    smallerIsBetter: boolean | null,
  ): ComparedFigure => ({ name, a: of(a), b: of(b), smallerIsBetter });
  const width = (values: readonly number[]): number => spreadOf(values).most - spreadOf(values).least;
  const parameters = Object.keys(a.review.sd).filter((name) => name in b.review.sd);
  return [
    figure("poses", ({ review }) => review.poses.length, null),
    figure("zone_mean", ({ review }) => review.working_zone.mean_px, true),
    figure("zone_worst", ({ review }) => review.working_zone.worst_px, true),
    figure("valid_worst", ({ review }) => review.valid_region.worst_px, true),
    figure("norm", ({ set }) => set.prediction?.norm_px ?? null, true),
    ...parameters.map((name) => figure(`sd_${name}`, ({ review }) => review.sd[name] ?? null, true)),
    figure("covered", ({ review }) => review.working_zone.covered_share, false),
    figure("pitch", ({ review }) => width(review.poses.map(({ pitch_deg }) => pitch_deg)), null),
    figure("yaw", ({ review }) => width(review.poses.map(({ yaw_deg }) => yaw_deg)), null),
    figure("nearest", ({ review }) => spreadOf(review.poses.map(({ distance_m }) => distance_m)).least, null),
    figure("farthest", ({ review }) => spreadOf(review.poses.map(({ distance_m }) => distance_m)).most, null),
    figure(
      "square",
      ({ review }) => spreadOf(review.poses.map(({ smallest_square_px }) => smallest_square_px)).least,
      null,
    ),
  ];
}

const SAME = 0.005;

/** How the second compares to the first. */
export function judged({ a, b, smallerIsBetter }: ComparedFigure): "better" | "worse" | "same" | null {
  if (a === null || b === null || smallerIsBetter === null) return null;
  if (Math.abs(b - a) <= SAME * Math.abs(a)) return "same";
  return b < a === smallerIsBetter ? "better" : "worse";
}
