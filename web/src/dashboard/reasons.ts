// Which gates speak against a calibration, the worst first, and how gates are grouped for reading.
import type { Measurement } from "../generated/api";

const SEVERITY: Readonly<Record<string, number>> = { FAIL: 2, MARGINAL: 1, PASS: 0 };

function severity(measurement: Measurement): number {
  return SEVERITY[measurement.verdict] ?? 0;
}

/** Share of the limit by which a value misses it; what is not determined or not numeric comes first. */
function miss(measurement: Measurement): number {
  const { margin, limit } = measurement;
  if (margin === null || limit === null || limit === 0) return Number.POSITIVE_INFINITY;
  return -margin / Math.abs(limit);
}

export function reasonsOf(gates: readonly Measurement[]): Measurement[] {
  return gates
    .filter((gate) => gate.verdict !== "PASS")
    .sort((a, b) => severity(b) - severity(a) || (miss(b) > miss(a) ? 1 : miss(b) < miss(a) ? -1 : 0));
}

export interface GateGroup {
  gate: string;
  measurements: Measurement[];
}

/** Measurements by gate, in the order in which the service gave them. */
export function groupGates(gates: readonly Measurement[]): GateGroup[] {
  const groups = new Map<string, Measurement[]>();
  for (const measurement of gates) {
    const group = groups.get(measurement.gate);
    if (group === undefined) groups.set(measurement.gate, [measurement]);
    else group.push(measurement);
  }
  return [...groups].map(([gate, measurements]) => ({ gate, measurements }));
}
