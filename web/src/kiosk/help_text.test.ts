import { describe, expect, it } from "vitest";
import { en } from "../words/en";
import { addedText, helpText } from "./help_text";

const LIVE = { instead_of: null, tried_s: 0, absent_s: 0 };

describe("what helps on", () => {
  it("says what to do about the light", () => {
    expect(helpText("more-light", LIVE, en)).toBe(en.help_more_light);
    expect(helpText("less-light", LIVE, en)).toBe(en.help_less_light);
  });

  it("says that another pose comes first, and not for ever", () => {
    const other = { ...LIVE, instead_of: 2 };
    expect(helpText("move-left", other, en)).toBe(en.help_another_first);
    expect(helpText("move-left", { ...other, tried_s: 9 }, en)).toBeNull();
    expect(helpText("move-left", LIVE, en)).toBeNull();
  });

  it("says why a pose is asked for that is not of the set", () => {
    const pose = { added_for: "out-of-reach" } as const;
    expect(addedText(pose, en)).toBe(en.help_added_reach);
    expect(helpText("move-left", { ...LIVE, instead_of: 2 }, en, pose)).toBe(en.help_added_reach);
    expect(addedText({ added_for: null }, en)).toBeNull();
  });

  it("says that nobody holds a board, after a while", () => {
    expect(helpText("show-board", { ...LIVE, absent_s: 3 }, en)).toBeNull();
    expect(helpText("show-board", { ...LIVE, absent_s: 30 }, en)).toBe(en.help_board_away);
    expect(helpText("show-whole-board", { ...LIVE, absent_s: 30 }, en)).toBeNull();
  });
});
