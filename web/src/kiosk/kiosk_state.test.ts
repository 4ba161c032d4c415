import { describe, expect, it } from "vitest";
import type { ServerMessage } from "../generated/protocol";
import { FIRST_STATE, isFinishing, isLive, nextState, screenOf, type KioskState } from "./kiosk_state";
import { accepted, live, problem, run, verdict, welcome } from "./messages.samples";

function after(...messages: ServerMessage[]): KioskState {
  return messages.reduce((state, message) => nextState(state, { kind: "told", message }), FIRST_STATE);
}

const RUNNING = [welcome({ run_id: "run-1" }), run({})] as const;

describe("the screen", () => {
  it("goes from the serial to the guidance to the verdict and back", () => {
    expect(screenOf(FIRST_STATE)).toBe("connecting");
    expect(screenOf(after(welcome({})))).toBe("start");
    expect(screenOf(after(welcome({}), run({})))).toBe("guide");
    expect(screenOf(after(welcome({}), run({}), verdict({})))).toBe("verdict");
    expect(
      screenOf(
        after(welcome({}), run({}), verdict({}), {
          type: "run_closed",
          run_id: "run-1",
          reason: "next_vehicle",
        }),
      ),
    ).toBe("start");
  });

  it("shows no verdict when everything is captured: only the service's word counts", () => {
    const state = after(
      ...RUNNING,
      accepted({ captured: [0, 1, 2] }),
      live({ pose_index: null, captured: 3 }),
    );

    expect(screenOf(state)).toBe("guide");
    expect(isFinishing(state)).toBe(true);
  });

  it("is closed when the first hello is refused, and keeps the run when the socket is lost later", () => {
    const lost = { kind: "lost", code: 1006, isFinal: false } as const;

    expect(screenOf(nextState(FIRST_STATE, { ...lost, code: 4404, isFinal: true }))).toBe("closed");
    expect(screenOf(nextState(after(...RUNNING), lost))).toBe("guide");
  });

  it("is closed when the key is taken away in mid-run", () => {
    expect(screenOf(nextState(after(...RUNNING), { kind: "lost", code: 4401, isFinal: true }))).toBe(
      "closed",
    );
  });
});

describe("a run", () => {
  it("goes on where it was when the page comes back", () => {
    const state = after(...RUNNING, accepted({ captured: [0] }));
    const back = [welcome({ run_id: "run-1" }), run({ captured: [0], pose_index: 1 })];
    const again = back.reduce((known, message) => nextState(known, { kind: "told", message }), state);

    expect(again.run?.captured).toEqual([0]);
    expect(again.run?.pose_index).toBe(1);
    expect(screenOf(again)).toBe("guide");
  });

  it("is gone when the service no longer has it", () => {
    const state = nextState(after(...RUNNING), { kind: "told", message: welcome({ run_id: null }) });

    expect(screenOf(state)).toBe("start");
  });

  it("keeps its verdict on show over a lost socket", () => {
    const shown = after(...RUNNING, verdict({ verdict: "FAIL" }));
    const state = nextState(shown, { kind: "told", message: welcome({ run_id: null }) });

    expect(screenOf(state)).toBe("verdict");
    expect(state.verdict?.verdict).toBe("FAIL");
  });

  it("takes no frame of another run", () => {
    expect(after(...RUNNING, live({ run_id: "run-0" })).live).toBeNull();
  });

  it("takes no frame that comes late, when the socket is lost already", () => {
    const lost = nextState(after(...RUNNING), { kind: "lost", code: 1006, isFinal: false });

    expect(nextState(lost, { kind: "told", message: live({}) }).live).toBeNull();
  });

  it("learns from frames which pose is asked for", () => {
    expect(after(...RUNNING, live({ pose_index: 2 })).run?.pose_index).toBe(2);
  });

  it("counts every stored capture, so that each is heard once", () => {
    const state = after(...RUNNING, accepted({ captured: [0] }), accepted({ captured: [0, 1] }));

    expect(state.stored.count).toBe(2);
    expect(state.run?.captured).toEqual([0, 1]);
  });

  it("forgets the old verdict when the next run begins", () => {
    expect(after(...RUNNING, verdict({}), run({ run_id: "run-2" })).verdict).toBeNull();
  });
});

describe("a problem", () => {
  it("of the picture is over with the next picture", () => {
    expect(after(...RUNNING, problem({ code: "source-stalled" }), live({})).problem).toBeNull();
  });

  it("of the picture leaves no guidance from before it", () => {
    const told = [...RUNNING, live({}), problem({ code: "source-stalled" })];

    expect(after(...told).live).toBeNull();
    expect(isLive(after(...told))).toBe(false);
    expect(isLive(after(...told, live({})))).toBe(true);
  });

  it("of another kind stays while frames come, and goes with the next capture", () => {
    const told = [...RUNNING, problem({ code: "sku-retired" }), live({})];

    expect(after(...told).problem?.code).toBe("sku-retired");
    expect(after(...told, accepted({})).problem).toBeNull();
  });

  it("can be put away", () => {
    expect(nextState(after(problem({})), { kind: "read" }).problem).toBeNull();
  });
});

it("a message of a newer service changes nothing", () => {
  const before = after(...RUNNING);

  expect(
    nextState(before, { kind: "told", message: { type: "brand_new" } as unknown as ServerMessage }),
  ).toBe(before);
});
