// The measurements of two runs, gate by gate, brought together by their names.
import type { Measurement } from "../generated/api";

export interface GatePair {
  gate: string;
  name: string;
  a: Measurement | null;
  b: Measurement | null;
}

/** In the order of the first run; what only the second one has comes at its end. */
export function pairGates(a: readonly Measurement[], b: readonly Measurement[]): GatePair[] {
  const first = new Map(a.map((one) => [keyOf(one), one]));
  const second = new Map(b.map((one) => [keyOf(one), one]));
  return [...new Set([...first.keys(), ...second.keys()])].flatMap((key) => {
    const [one, other] = [first.get(key) ?? null, second.get(key) ?? null];
    const known = one ?? other;
    return known === null ? [] : [{ gate: known.gate, name: known.name, a: one, b: other }];
  });
}

function keyOf({ gate, name }: Measurement): string {
  return `${gate}.${name}`;
}
