import { describe, expect, it } from "vitest";
import type { Difference } from "../generated/protocol";
import { sideView } from "./side_view";

const FLAT = { tilt_deg: 0, turn_deg: 0, roll_deg: 0, distance_m: 0.5 };
const DIFFERENCE: Difference = {
  right_px: 0,
  down_px: 0,
  closer_share: 0,
  tilt_deg: 30,
  turn_deg: 30,
  roll_deg: 0,
  corner_px: 13,
  is_upside_down: false,
};

describe("the view from the side, camera on the left", () => {
  it("shows the top of the wanted board nearer to the camera when it must come forward", () => {
    const view = sideView("tilt-top-forward", { ...FLAT, tilt_deg: 30 }, DIFFERENCE, false);

    expect(view?.view).toBe("side");
    expect(view?.wanted[0].x).toBeLessThan(104);
    expect(view?.present[0].x).toBeCloseTo(104, 6);
    expect(view?.bend.to.x).toBeLessThan(view?.bend.from.x ?? 0);
    expect(view?.bend.isClockwise).toBe(false);
  });

  it("shows it farther away when it must go back", () => {
    const view = sideView("tilt-top-back", { ...FLAT, tilt_deg: -30 }, DIFFERENCE, false);

    expect(view?.wanted[0].x).toBeGreaterThan(view?.present[0].x ?? 999);
  });

  it("makes small ways large enough to be read", () => {
    const view = sideView("tilt-top-back", FLAT, { ...DIFFERENCE, tilt_deg: -1 }, false);

    expect((view?.bend.to.x ?? 0) - (view?.bend.from.x ?? 0)).toBeGreaterThan(14);
  });
});

describe("the view from above, camera below", () => {
  it("shows the left edge farther up when it must go away", () => {
    const view = sideView("turn-left-back", { ...FLAT, turn_deg: 30 }, DIFFERENCE, false);

    expect(view?.view).toBe("top");
    expect(view?.wanted[0].y).toBeLessThan(view?.present[0].y ?? 0);
    expect(view?.bend.from.x).toBeLessThan(80);
  });

  it("is the mirror image on a mirrored display", () => {
    const plain = sideView("turn-left-back", { ...FLAT, turn_deg: 30 }, DIFFERENCE, false);
    const mirrored = sideView("turn-right-back", { ...FLAT, turn_deg: 30 }, DIFFERENCE, true);

    expect(mirrored?.wanted[1].x).toBeCloseTo(160 - (plain?.wanted[0].x ?? 0), 6);
    expect(mirrored?.wanted[1].y).toBeCloseTo(plain?.wanted[0].y ?? 0, 6);
    expect(mirrored?.bend.isClockwise).toBe(!plain?.bend.isClockwise);
  });
});

it("a shift needs no view from the side", () => {
  expect(sideView("move-left", FLAT, DIFFERENCE, false)).toBeNull();
});
