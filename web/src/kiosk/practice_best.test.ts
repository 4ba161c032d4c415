import { describe, expect, it } from "vitest";
import { bestName, isBetter, readBests, withBest } from "./practice_best";

const BEST = { points: 300, took_ms: 20_000 };

describe("a best", () => {
  it("is beaten by more points, or by as many in less time", () => {
    expect(isBetter(BEST, null)).toBe(true);
    expect(isBetter({ points: 301, took_ms: 90_000 }, BEST)).toBe(true);
    expect(isBetter({ points: 300, took_ms: 19_999 }, BEST)).toBe(true);
    expect(isBetter(BEST, BEST)).toBe(false);
    expect(isBetter({ points: 299, took_ms: 1 }, BEST)).toBe(false);
  });

  it("belongs to a badge and the poses that were asked for", () => {
    const names = [
      bestName("4711", "lens1", 10),
      bestName("4712", "lens1", 10),
      bestName("4711", "lens1", 12),
    ];
    expect(new Set(names).size).toBe(3);
    expect(bestName(" 4711 ", "lens1", 10)).toBe(names[0]);
  });

  it("is read from what was stored, whatever else lies there", () => {
    const name = bestName("4711", "lens1", 10);
    expect(readBests(JSON.stringify(withBest({}, name, BEST)))).toEqual({ [name]: BEST });
    expect(readBests(JSON.stringify({ [name]: BEST, odd: { points: "many" }, none: null }))).toEqual({
      [name]: BEST,
    });
    for (const odd of [null, "", "{", "7", "[1]"]) expect(readBests(odd)).toEqual({});
  });

  it("pushes the oldest out once there are too many", () => {
    let bests = withBest({}, "first", BEST);
    for (let i = 0; i < 500; i++) bests = withBest(bests, `badge ${i}`, BEST);
    expect(Object.keys(bests)).toHaveLength(500);
    expect(bests["first"]).toBeUndefined();
  });
});
