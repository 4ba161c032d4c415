import { describe, expect, it } from "vitest";
import { choose } from "./sku_choice";

describe("the camera type", () => {
  it("is the one that this station used last", () => {
    expect(choose("lens2", ["lens1", "lens2"])).toBe("lens2");
  });

  it("is never one that is no longer offered", () => {
    expect(choose("retired", ["lens1", "lens2"])).toBeNull();
  });

  it("is not asked for when there is only one", () => {
    expect(choose(null, ["lens1"])).toBe("lens1");
  });
});
