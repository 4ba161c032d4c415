import { describe, expect, it } from "vitest";
import { splitKey } from "./address_key";

describe("a key in the address", () => {
  it("is taken out, and nothing is left behind", () => {
    expect(splitKey("#key=dmscal_1a_x-Y")).toEqual({ key: "dmscal_1a_x-Y", rest: "" });
  });

  it("leaves the page that was asked for with it", () => {
    expect(splitKey("#key=k&/runs/7")).toEqual({ key: "k", rest: "#/runs/7" });
  });

  it("is decoded where it can be, and taken as it is where not", () => {
    expect(splitKey("#key=a%2Fb").key).toBe("a/b");
    expect(splitKey("#key=100%").key).toBe("100%");
  });

  it.each(["", "#/runs", "#key=", "#/runs?serial=key=1"])("is not seen in %j", (hash) => {
    expect(splitKey(hash)).toEqual({ key: null, rest: hash });
  });
});
