// Whether nobody is there. No clock: times come in.
import { isOnline, screenOf, type KioskState } from "./kiosk_state";

/** A walk to the next vehicle takes less. */
export const IDLE_AFTER_MS = 90_000;

/** Nothing is under way, nothing is wrong, and a scan would be taken: only then may the screen rest. */
export function mayRest(state: KioskState): boolean {
  const hasSku = (state.welcome?.skus.length ?? 0) > 0;
  return screenOf(state) === "start" && isOnline(state) && state.problem === null && hasSku;
}

/** A key that wakes the screen and does nothing else; letters go on, for they may begin a scan. */
export function onlyWakes(key: string): boolean {
  return key.length !== 1 || key === " ";
}
