// How much of a limit a measurement uses, as a bar. The limit's tick stands at one place for every gate, and left of
// it is good, whether the value must stay below the limit or above it.

/** Place of the limit's tick along the bar. */
export const LIMIT_AT = 0.7;

/** Share of the limit that is used: 1 at the limit, less on the good side; null where there is nothing to compare. */
export function usedShare(value: number | null, limit: number | null, comparison: string): number | null {
  if (value === null || limit === null || limit <= 0 || comparison === "==") return null;
  if (comparison === "<=") return Math.max(0, value / limit);
  return value > 0 ? limit / value : Number.POSITIVE_INFINITY;
}

/** Where the bar of a share ends, 0 to 1. */
export function barEnd(share: number): number {
  return Math.min(1, share * LIMIT_AT);
}
