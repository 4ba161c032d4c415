// How much of a limit a measurement uses, as a bar: the limit's tick stands at one place for every gate.

type Comparison = string;

export interface MarginBar {
  /** Where the value ends, 0 to 1 of the bar. */
  value: number;
  /** value / limit, for the words beside the bar. */
  share: number;
  /** The good side: left of the tick for "at most", right of it for "at least". */
  good: "left" | "right";
}

/** Place of the limit's tick along the bar. */
export const LIMIT_AT = 0.7;

export function marginBar(
  value: number | null,
  limit: number | null,
  comparison: Comparison,
): MarginBar | null {
  if (value === null || limit === null || limit <= 0 || comparison === "==") return null;
  const share = value / limit;
  return {
    value: Math.min(1, Math.max(0, share * LIMIT_AT)),
    share,
    good: comparison === ">=" ? "right" : "left",
  };
}
