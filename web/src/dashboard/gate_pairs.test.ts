import { describe, expect, it } from "vitest";
import type { Measurement } from "../generated/api";
import { pairGates } from "./gate_pairs";

function measured(gate: string, name: string): Measurement {
  return { gate, name } as Measurement;
}

describe("the gates of two runs", () => {
  it("stand beside each other, also those that one run lacks", () => {
    const a = [measured("fit", "rms_px"), measured("cross_check", "half_difference")];
    const b = [measured("fit", "rms_px"), measured("identity", "score")];

    expect(pairGates(a, b).map((pair) => [pair.name, pair.a !== null, pair.b !== null])).toEqual([
      ["rms_px", true, true],
      ["half_difference", true, false],
      ["score", false, true],
    ]);
  });
});
