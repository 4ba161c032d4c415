import { describe, expect, it } from "vitest";
import type { Measurement } from "../generated/api";
import { groupGates, reasonsOf } from "./reasons";

function measurement(
  name: string,
  verdict: Measurement["verdict"],
  more: Partial<Measurement> = {},
): Measurement {
  const rest = {
    gate: "fit",
    value: 1,
    unit: "px",
    limit: 1,
    comparison: "<=",
    margin: 0,
    advice: "",
    reason: null,
    facts: null,
  } as const;
  return { ...rest, name, verdict, ...more };
}

describe("reasons of a verdict", () => {
  it("leave out what passed and begin with the worst miss", () => {
    const gates = [
      measurement("passed", "PASS"),
      measurement("close", "MARGINAL", { margin: 0.1 }),
      measurement("little", "FAIL", { margin: -0.1 }),
      measurement("much", "FAIL", { margin: -3 }),
    ];
    expect(reasonsOf(gates).map((gate) => gate.name)).toEqual(["much", "little", "close"]);
  });

  it("begin with what could not be measured at all", () => {
    const gates = [
      measurement("much", "FAIL", { margin: -3 }),
      measurement("unknown", "FAIL", { value: null, margin: null }),
    ];
    expect(reasonsOf(gates)[0]?.name).toBe("unknown");
  });
});

describe("groups of gates", () => {
  it("keep the service's order and bring together what belongs together", () => {
    const gates = [
      measurement("a", "PASS", { gate: "frame" }),
      measurement("b", "PASS", { gate: "fit" }),
      measurement("c", "PASS", { gate: "frame" }),
    ];
    const names = groupGates(gates).map((group) => [group.gate, ...group.measurements.map((m) => m.name)]);
    expect(names).toEqual([
      ["frame", "a", "c"],
      ["fit", "b"],
    ]);
  });
});
