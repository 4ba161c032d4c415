import { describe, expect, it } from "vitest";
import { pairOf, withRun, type ChosenRun } from "./chosen_runs";

const [first, second, third] = ["1", "2", "3"].map((id) => ({
  id,
  serial: `VIN-${id}`,
  created_at: `2026-01-0${id}T00:00:00Z`,
})) as [ChosenRun, ChosenRun, ChosenRun];

describe("runs to compare", () => {
  it("are two at most, and the third takes the place of the first", () => {
    const two = withRun(withRun([], first, true), second, true);
    expect(two).toEqual([first, second]);
    expect(withRun(two, third, true)).toEqual([second, third]);
    expect(withRun(two, first, false)).toEqual([second]);
    expect(withRun(two, second, true)).toEqual([first, second]);
  });

  it("are compared with the older one first", () => {
    expect(pairOf([third, first])).toEqual([first, third]);
    expect(pairOf([third])).toBeNull();
  });
});
