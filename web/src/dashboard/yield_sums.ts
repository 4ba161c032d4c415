// Sums of the counts that the service gives by SKU, station and day.
import type { YieldCount } from "../generated/api";

export interface Sums {
  passed: number;
  marginal: number;
  failed: number;
  firstRuns: number;
  firstPassed: number;
}

export function sumOf(counts: readonly YieldCount[]): Sums {
  const sums: Sums = { passed: 0, marginal: 0, failed: 0, firstRuns: 0, firstPassed: 0 };
  for (const count of counts) {
    sums.passed += count.passed;
    sums.marginal += count.marginal;
    sums.failed += count.failed;
    sums.firstRuns += count.first_runs;
    sums.firstPassed += count.first_passed;
  }
  return sums;
}

/** Sums of what has the same key, in the order in which the keys first appear. */
export function sumsBy<K>(
  counts: readonly YieldCount[],
  keyOf: (count: YieldCount) => K,
): { key: K; sums: Sums }[] {
  const groups = new Map<K, YieldCount[]>();
  for (const count of counts) {
    const key = keyOf(count);
    const group = groups.get(key);
    if (group === undefined) groups.set(key, [count]);
    else group.push(count);
  }
  return [...groups].map(([key, group]) => ({ key, sums: sumOf(group) }));
}

export function runsOf({ passed, marginal, failed }: Sums): number {
  return passed + marginal + failed;
}

/** Share of first runs that passed; null without a first run. */
export function firstPassYield({ firstRuns, firstPassed }: Sums): number | null {
  return firstRuns === 0 ? null : firstPassed / firstRuns;
}

/** Every day from `since` to `until`, both included, as the service writes days. */
export function daysBetween(since: string, until: string): string[] {
  const days: string[] = [];
  const last = Date.parse(`${until}T00:00:00Z`);
  for (let at = Date.parse(`${since}T00:00:00Z`); at <= last; at += 86_400_000) {
    days.push(new Date(at).toISOString().slice(0, 10));
  }
  return days;
}
