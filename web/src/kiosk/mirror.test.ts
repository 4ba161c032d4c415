import { describe, expect, it } from "vitest";
import { hintOnDisplay, type HintCode } from "./mirror";

const SIDEWAYS: [HintCode, HintCode][] = [
  ["move-left", "move-right"],
  ["turn-left-back", "turn-right-back"],
  ["rotate-clockwise", "rotate-counterclockwise"],
];
const SAME: HintCode[] = ["move-up", "move-down", "move-closer", "tilt-top-back", "turn-upside-down", "hold"];

describe("a mirrored display", () => {
  it.each(SIDEWAYS)("swaps %s and %s", (one, other) => {
    expect(hintOnDisplay(one, true)).toBe(other);
    expect(hintOnDisplay(other, true)).toBe(one);
  });

  it.each(SAME)("leaves %s", (code) => {
    expect(hintOnDisplay(code, true)).toBe(code);
  });

  it("swaps nothing when it is off", () => {
    expect(hintOnDisplay("move-left", false)).toBe("move-left");
  });
});
