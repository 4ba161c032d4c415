import { describe, expect, it } from "vitest";
import { mayRest, onlyWakes } from "./idle";
import { FIRST_STATE, nextState, type KioskEvent, type KioskState } from "./kiosk_state";
import { problem, run, verdict, welcome } from "./messages.samples";

function after(...messages: (KioskEvent & { kind: "told" })["message"][]): KioskState {
  return messages.reduce((state, message) => nextState(state, { kind: "told", message }), FIRST_STATE);
}

describe("the screen may rest", () => {
  it("while a scan is waited for", () => {
    expect(mayRest(after(welcome({})))).toBe(true);
  });

  it("but not before the station is known, in a run, at a verdict, or with something to read", () => {
    expect(mayRest(FIRST_STATE)).toBe(false);
    expect(mayRest(after(welcome({}), run({})))).toBe(false);
    expect(mayRest(after(welcome({}), run({}), verdict({})))).toBe(false);
    expect(mayRest(after(welcome({}), problem({})))).toBe(false);
    expect(mayRest(after(welcome({ skus: [] })))).toBe(false);
  });

  it("nor while nobody answers", () => {
    const lost = nextState(after(welcome({})), { kind: "lost", code: 1006, isFinal: false });
    expect(mayRest(lost)).toBe(false);
  });
});

it("a key that may begin a scan is let through, others only wake", () => {
  expect(["V", "4", "-"].map(onlyWakes)).toEqual([false, false, false]);
  expect([" ", "Enter", "Escape", "Tab", "Backspace"].map(onlyWakes)).toEqual([true, true, true, true, true]);
});
