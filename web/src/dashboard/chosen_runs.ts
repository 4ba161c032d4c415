// The runs that are chosen to be compared: two at most, kept from page to page until they are let go.
import { signal } from "@preact/signals";

export interface ChosenRun {
  id: string;
  serial: string;
  created_at: string;
}

const MOST = 2;

export const chosenRuns = signal<readonly ChosenRun[]>([]);

/** Takes a run in or lets it go; a third one takes the place of the first. */
export function withRun(
  chosen: readonly ChosenRun[],
  run: ChosenRun,
  isChosen: boolean,
): readonly ChosenRun[] {
  const others = chosen.filter(({ id }) => id !== run.id);
  return isChosen ? [...others, run].slice(-MOST) : others;
}

/** The pair with the older run first, so that what came of it is the second; null without two. */
export function pairOf(chosen: readonly ChosenRun[]): readonly [ChosenRun, ChosenRun] | null {
  const [a, b] = [...chosen].sort((one, other) => one.created_at.localeCompare(other.created_at));
  return a === undefined || b === undefined ? null : [a, b];
}
