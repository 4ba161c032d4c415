import { describe, expect, it } from "vitest";
import type { State } from "../generated/protocol";
import { live, run } from "./messages.samples";
import { sceneOf } from "./stage_scene";

const BOARD = { columns: 3, rows: 3, dot_steps: null };
const RUN = run({ board: BOARD });

function grid(left: number, top: number): [number, number][] {
  return [0, 1, 2].flatMap((row) =>
    [0, 1, 2].map((column): [number, number] => [left + 20 * column, top + 20 * row]),
  );
}

function outline(left: number, top: number): [number, number][] {
  return [
    [left, top],
    [left + 40, top],
    [left + 40, top + 40],
    [left, top + 40],
  ];
}

function stateAt(left: number, more: Partial<State>): State {
  return live({
    board: "present",
    seen: { outline: outline(left, 100), corners: grid(left, 100), angles: null },
    ghost: { outline: outline(200, 100), corners: grid(200, 100) },
    ...more,
  });
}

describe("the scene over the picture", () => {
  it("leads each corner to the wanted board", () => {
    const scene = sceneOf(RUN, stateAt(100, { hints: [{ code: "move-right", amount: 1 }] }));

    expect(scene.arrows).toHaveLength(4);
    expect(scene.arrows[0]).toEqual({ from: { x: 100, y: 100 }, to: { x: 200, y: 100 } });
    expect(scene.axis).toBeNull();
  });

  it("shows the wanted squares strongly from afar and not at all when the board is there", () => {
    expect(sceneOf(RUN, stateAt(100, {})).cellsAlpha).toBe(1);
    expect(sceneOf(RUN, stateAt(200, {})).cellsAlpha).toBe(0);
    const near = sceneOf(RUN, stateAt(190, {})).cellsAlpha;
    expect(near).toBeGreaterThan(0);
    expect(near).toBeLessThan(1);
  });

  it("fills light squares only: those beside the dark one at corner 0", () => {
    const { cells } = sceneOf(RUN, stateAt(100, {}));

    expect(cells).toHaveLength(2);
    expect(cells[0]?.[0]).toEqual({ x: 220, y: 100 });
    expect(cells[1]?.[0]).toEqual({ x: 200, y: 120 });
  });

  it("marks the first square of both boards, by which a board turned round is known", () => {
    const scene = sceneOf(RUN, stateAt(100, { hints: [{ code: "turn-upside-down", amount: 1 }] }));

    expect(scene.isUpsideDown).toBe(true);
    expect(scene.seen?.first).toEqual({ x: 110, y: 110 });
    expect(scene.wanted?.first).toEqual({ x: 210, y: 110 });
  });

  it("of a board that is not wholly seen has the wanted board and no arrows", () => {
    const hints = [{ code: "show-whole-board", amount: 1 } as const];
    const scene = sceneOf(RUN, stateAt(100, { board: "partial", seen: null, hints }));

    expect([scene.seen, scene.arrows, scene.cellsAlpha]).toEqual([null, [], 1]);
    expect(scene.wanted?.corners).toHaveLength(4);
  });

  it("is good with a ring only while the board is held in its place", () => {
    expect(sceneOf(RUN, stateAt(200, { match: 0.9 })).isMatch).toBe(false);
    const held = sceneOf(RUN, stateAt(200, { match: 1, dwell: 0.4 }));
    expect([held.isMatch, held.dwell]).toEqual([true, 0.4]);
    expect(sceneOf(RUN, stateAt(200, { is_capturing: true })).dwell).toBe(1);
    expect(sceneOf(RUN, stateAt(200, {})).dwell).toBeNull();
  });
});
