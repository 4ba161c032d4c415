import { describe, expect, it } from "vitest";
import { de } from "../words/de";
import { en } from "../words/en";
import { zh } from "../words/zh";
import { stepsOf, stepText } from "./steps";

describe("steps", () => {
  it("are one for a shift to the side and one up or down, whichever comes first", () => {
    expect(stepsOf(["move-left", "move-up", "tilt-top-back"])).toEqual([
      { code: "move-left", beside: "move-up" },
      { code: "tilt-top-back", beside: null },
    ]);
    expect(stepsOf(["move-down", "move-right"])).toEqual([{ code: "move-down", beside: "move-right" }]);
  });

  it("stay apart where movements are no shifts across the picture", () => {
    expect(stepsOf(["move-left", "move-closer"]).map(({ beside }) => beside)).toEqual([null, null]);
    expect(stepsOf([])).toEqual([]);
  });

  it.each([
    [en, "Move *left and up*"],
    [de, "Nach *links oben*"],
    [zh, "向*左上*移"],
  ])("that slant are said in one", (say, text) => {
    expect(stepText({ code: "move-left", beside: "move-up" }, say)).toBe(text);
    expect(stepText({ code: "move-up", beside: "move-left" }, say)).toBe(text);
    expect(stepText({ code: "move-closer", beside: null }, say)).toBe(say.hint_move_closer);
  });

  it("read differently for each of the four ways", () => {
    const ways = (["move-left", "move-right"] as const).flatMap((code) =>
      (["move-up", "move-down"] as const).map((beside) => stepText({ code, beside }, de)),
    );
    expect(new Set(ways).size).toBe(4);
  });
});
