// A parameter's values over the runs of one serial: what is drawn, and the range that shows it. Pure.
import type { Verdict } from "../generated/api";
import { median } from "./scales";

export interface HistoryPoint {
  value: number;
  /** One standard deviation; null where there is none. */
  sd: number | null;
  verdict: Verdict;
  /** Whether it is the run on show. */
  isHere: boolean;
}

const AIR = 0.12;
/** Bars of so many typical sd are shown whole; those of a run that knows less are cut off. */
const SD_SHOWN = 3;

/** `shown`: values that are within the range too. */
export function historyRange(
  points: readonly HistoryPoint[],
  shown: readonly number[] = [],
): [number, number] {
  const values = points.map(({ value }) => value);
  const known = points.flatMap(({ sd }) => (sd === null ? [] : [sd]));
  const typical = known.length === 0 ? 0 : median(known);
  const reach = (sd: number | null): number => Math.min(sd ?? 0, SD_SHOWN * typical);
  const low = Math.min(...shown, ...points.map(({ value, sd }) => value - reach(sd)));
  const high = Math.max(...shown, ...points.map(({ value, sd }) => value + reach(sd)));
  const span = high - low || Math.abs(values[0] ?? 1) * 1e-3 || 1;
  return [low - AIR * span, high + AIR * span];
}
