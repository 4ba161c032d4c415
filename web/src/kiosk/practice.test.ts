import { describe, expect, it } from "vitest";
import { run } from "./messages.samples";
import { followRun, isPractice, PAR_MS, practiceSerial, scoreOf, type Practice } from "./practice";

const SERIAL = practiceSerial(new Date("2026-11-27T11:22:33.456Z"));

function at(captured: number[], serial = SERIAL): ReturnType<typeof run> {
  return run({ serial, purpose: "trial", captured });
}

function followed(...looks: [captured: number[], at_ms: number, isSeen?: boolean][]): Practice {
  let practice: Practice | null = null;
  for (const [captured, at_ms, isSeen = true] of looks)
    practice = followRun(practice, at(captured), isSeen, at_ms);
  return practice ?? expect.fail("no practice");
}

function laps(...took_ms: number[]): Practice {
  const timed = took_ms.map((took, pose_index) => ({ pose_index, took_ms: took }));
  return { run_id: "run-1", total: 3, laps: timed, untimed: [], since_ms: 0 };
}

describe("a practice", () => {
  it("is known by its serial and a purpose that never counts for yield", () => {
    expect(SERIAL).toBe("PRACTICE-20261127-112233456");
    expect(isPractice({ serial: SERIAL, purpose: "trial" })).toBe(true);
    expect(isPractice({ serial: SERIAL, purpose: "simulated" })).toBe(true);
    expect(isPractice({ serial: SERIAL, purpose: "production" })).toBe(false);
    expect(isPractice({ serial: "VIN-1", purpose: "trial" })).toBe(false);
    expect(followRun(null, at([], "VIN-1"), true, 0)).toBeNull();
  });

  it("times each pose from the one before, and the first from the first picture", () => {
    const practice = followed([[], 1000, false], [[], 5000], [[0], 9000], [[0, 1], 11_000]);
    expect(practice.laps).toEqual([
      { pose_index: 0, took_ms: 4000 },
      { pose_index: 1, took_ms: 2000 },
    ]);
  });

  it("forgets a capture that was withdrawn, and times its pose again", () => {
    const practice = followed([[], 0], [[0], 4000], [[], 5000], [[0], 12_000]);
    expect(practice.laps).toEqual([{ pose_index: 0, took_ms: 7000 }]);
  });

  it("has no time for poses that were taken before it looked, and is then not whole", () => {
    const practice = followed([[0], 0], [[0, 1], 3000], [[0, 1, 2], 6000]);
    expect(practice.untimed).toEqual([0]);
    expect(scoreOf(practice).isWhole).toBe(false);
  });

  it("stays the same object while nothing happens", () => {
    const practice = followed([[], 0], [[0], 4000]);
    expect(followRun(practice, at([0]), true, 4500)).toBe(practice);
  });
});

describe("the score", () => {
  it("is full, with a growing bonus, while every pose is under par", () => {
    const score = scoreOf(laps(1000, PAR_MS, 2000));
    expect([score.points, score.most]).toEqual([330, 330]);
    expect([score.streak, score.longest, score.underPar, score.isWhole]).toEqual([3, 3, 3, true]);
  });

  it("falls with the time over par, which also ends the streak", () => {
    const score = scoreOf(laps(3000, 2 * PAR_MS, 3000));
    expect(score.points).toBe(100 + 50 + 100);
    expect([score.streak, score.longest, score.underPar]).toEqual([1, 1, 2]);
    expect([score.took_ms, score.par_ms]).toEqual([18_000, 18_000]);
  });
});
