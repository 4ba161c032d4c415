// The API key of this browser tab: out of the address or the form, kept in sessionStorage, never in a link.
import { signal } from "@preact/signals";
import { splitKey } from "./address_key";

const STORED_AS = "dmscal.key";

export const key = signal<string | null>(sessionStorage.getItem(STORED_AS));

/** Why the service refused the last key, in its words. */
export const refusal = signal<string | null>(null);

export function rememberKey(value: string): void {
  refusal.value = null;
  sessionStorage.setItem(STORED_AS, value);
  key.value = value;
}

export function forgetKey(): void {
  sessionStorage.removeItem(STORED_AS);
  key.value = null;
}

export function dropRefusedKey(detail: string): void {
  refusal.value = detail;
  forgetKey();
}

/** Takes `#key=…` out of the address bar before anything is drawn, so that it is neither seen nor bookmarked. */
export function takeKeyFromAddress(): void {
  const { key: found, rest } = splitKey(window.location.hash);
  if (found === null) return;
  rememberKey(found);
  window.history.replaceState(null, "", `${window.location.pathname}${window.location.search}${rest}`);
}
