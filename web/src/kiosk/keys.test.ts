import { describe, expect, it } from "vitest";
import { commandOf, type Press } from "./keys";

function press(key: string, more: Partial<Press> = {}): Press {
  return { key, isRepeated: false, isModified: false, isOnControl: false, ...more };
}

describe("keys during guidance", () => {
  it.each([
    [" ", "capture"],
    ["Enter", "capture"],
    ["Backspace", "undo"],
    ["Escape", "abort"],
    ["F2", "figures"],
    ["x", null],
  ])("%j means %s", (key, command) => {
    expect(commandOf(press(key), "guide", false)).toBe(command);
  });

  it("capture once, however long the foot stays on the switch", () => {
    expect(commandOf(press(" ", { isRepeated: true }), "guide", false)).toBeNull();
  });

  it("belong to the button that has the focus, but for Esc", () => {
    expect(commandOf(press(" ", { isOnControl: true }), "guide", false)).toBeNull();
    expect(commandOf(press("Escape", { isOnControl: true }), "guide", false)).toBe("abort");
  });
});

it("keys do nothing while a question is open, with a modifier, or on another screen", () => {
  expect(commandOf(press("Enter"), "guide", true)).toBeNull();
  expect(commandOf(press("Enter", { isModified: true }), "guide", false)).toBeNull();
  expect(commandOf(press("Enter"), "verdict", false)).toBeNull();
});
