// What the key of this tab may do, so that pages offer only that. What is allowed the service decides each time.
import { computed, effect, signal } from "@preact/signals";
import type { Role } from "../generated/api";
import { getOwnKey } from "./client";
import { recoveries } from "./connection";
import { key } from "./key";
import { RequestFailed } from "./problem";

const role = signal<Role | null>(null);

/** Whether the key may change how the plant works: boards, stations. */
export const isEngineer = computed(() => role.value === "engineer" || role.value === "admin");

const asking = computed(() => ({ used: key.value, outages: recoveries.value }));

/** Asks with every new key, and again after an outage. */
export function followKey(): void {
  effect(() => {
    const { used } = asking.value;
    if (used === null) role.value = null;
    else void ask(used);
  });
}

async function ask(used: string): Promise<void> {
  try {
    const own = await getOwnKey();
    if (used === key.peek()) role.value = own.role;
  } catch (error) {
    // A refused key is told by the page that asks for it, and an outage by the bar.
    if (!(error instanceof RequestFailed)) throw error;
  }
}
