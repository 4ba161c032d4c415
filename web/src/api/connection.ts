// Is the service there? Set by every request; while it is not, the service is asked again until it answers.
import { signal } from "@preact/signals";

const RETRY_MS = 2000;

export const online = signal(true);
/** Counts recoveries: who loads something loads it again when this changes. */
export const recoveries = signal(0);

let retrying: number | undefined;

export function reportReached(): void {
  if (online.value) return;
  window.clearTimeout(retrying);
  retrying = undefined;
  online.value = true;
  recoveries.value += 1;
}

export function reportUnreached(): void {
  online.value = false;
  retrying ??= window.setTimeout(() => void probe(), RETRY_MS);
}

async function probe(): Promise<void> {
  retrying = undefined;
  try {
    const answer = await fetch("/livez", { cache: "no-store" });
    if (answer.ok) reportReached();
    else reportUnreached();
  } catch {
    reportUnreached();
  }
}
