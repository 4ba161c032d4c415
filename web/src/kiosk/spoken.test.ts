import { describe, expect, it } from "vitest";
import { en } from "../words/en";
import { zh } from "../words/zh";
import { FIRST_STATE, nextState, type KioskEvent, type KioskState } from "./kiosk_state";
import { live, problem, run, verdict, welcome } from "./messages.samples";
import { spokenOf } from "./spoken";

function after(...messages: (KioskEvent & { kind: "told" })["message"][]): KioskState {
  return [welcome({}), ...messages].reduce(
    (state, message) => nextState(state, { kind: "told", message }),
    FIRST_STATE,
  );
}

const MOVING = live({ hints: [{ code: "move-left", amount: 0.5 }] });

describe("what is spoken", () => {
  it("is the first instruction, as the display shows it, without the marks", () => {
    expect(spokenOf(after(run({}), MOVING), false, en)).toBe("Move left");
    expect(spokenOf(after(run({}), MOVING), true, en)).toBe("Move right");
    expect(spokenOf(after(run({}), MOVING), false, zh)).toBe("向左移");
  });

  it("is nothing before a run, and while a picture is being taken", () => {
    expect(spokenOf(after(), false, en)).toBeNull();
    expect(spokenOf(after(run({}), live({ is_capturing: true })), false, en)).toBeNull();
  });

  it("is a problem with what to do, but not one in another language", () => {
    expect(spokenOf(after(run({}), problem({ code: "frame-moved" })), false, en)).toBe(
      "The board moved. Hold it still until the tone.",
    );
    expect(spokenOf(after(run({}), problem({ code: "of-a-newer-service" })), false, en)).toBeNull();
  });

  it("is the result of a vehicle, and of a practice only its end", () => {
    expect(spokenOf(after(run({}), verdict({})), false, en)).toBe(
      "PASS. The camera is good. The result is stored.",
    );
    const practice = run({ serial: "PRACTICE-1", purpose: "trial" });
    expect(spokenOf(after(practice, verdict({})), false, en)).toBe("Practice is over");
  });
});
