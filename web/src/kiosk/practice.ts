// Practice: one run against the clock. What was taken when, and what that is worth. No clock, no screen, no storage.
import type { Run } from "../generated/protocol";

/** A run of ten poses in a minute. */
export const PAR_MS = 6000;
const POINTS = 100;
/** For each pose under par after the first one in a row, up to so much. */
const BONUS = 10;
const MOST_BONUS = 50;
const SERIAL = "PRACTICE-";

export interface Lap {
  pose_index: number;
  took_ms: number;
}

export interface Practice {
  run_id: string;
  total: number;
  /** Poses that were taken under these eyes, in the order they were taken. */
  laps: readonly Lap[];
  /** Poses that were taken before this page looked: nobody knows how long they took. */
  untimed: readonly number[];
  /** When the pose that is asked for now was first seen to be asked for; null before the first picture. */
  since_ms: number | null;
}

/** A serial that no vehicle has and that no other practice has. */
export function practiceSerial(now: Date): string {
  const [day = "", time = ""] = now.toISOString().split("T");
  return `${SERIAL}${day.replaceAll("-", "")}-${time.replace(/\D/g, "")}`;
}

/** By the run itself, so that a page which was loaded again knows it too. Neither purpose counts for yield. */
export function isPractice(run: Pick<Run, "purpose" | "serial"> | null): boolean {
  return (
    run !== null && (run.purpose === "trial" || run.purpose === "simulated") && run.serial.startsWith(SERIAL)
  );
}

/** The practice after a look at the run; `isSeen`: pictures of it come. The same object where nothing happened. */
export function followRun(
  before: Practice | null,
  run: Run | null,
  isSeen: boolean,
  at_ms: number,
): Practice | null {
  if (run === null || !isPractice(run)) return null;
  if (before?.run_id !== run.run_id) return begun(run, isSeen ? at_ms : null);
  const since_ms = before.since_ms ?? (isSeen ? at_ms : null);
  const known = [...before.untimed, ...before.laps.map((lap) => lap.pose_index)];
  const taken = run.captured.filter((pose) => !known.includes(pose));
  const isWithdrawn = known.some((pose) => !run.captured.includes(pose));
  if (taken.length === 0 && !isWithdrawn)
    return since_ms === before.since_ms ? before : { ...before, since_ms };
  return captured({ ...before, since_ms }, run.captured, taken, at_ms);
}

function captured(
  before: Practice,
  all: readonly number[],
  taken: readonly number[],
  at_ms: number,
): Practice {
  const { since_ms } = before;
  const laps = before.laps.filter((lap) => all.includes(lap.pose_index));
  const untimed = before.untimed.filter((pose) => all.includes(pose));
  if (since_ms === null) return { ...before, laps, untimed: [...untimed, ...taken] };
  const timed = taken.map((pose_index) => ({ pose_index, took_ms: at_ms - since_ms }));
  return { ...before, laps: [...laps, ...timed], untimed, since_ms: at_ms };
}

function begun(run: Run, since_ms: number | null): Practice {
  return { run_id: run.run_id, total: run.total, laps: [], untimed: run.captured, since_ms };
}

export interface Score {
  points: number;
  most: number;
  /** Poses of the run. */
  total: number;
  /** Poses under par in a row: now, and at best. */
  streak: number;
  longest: number;
  underPar: number;
  took_ms: number;
  par_ms: number;
  /** Every pose was timed. */
  isWhole: boolean;
}

export function scoreOf({ laps, total }: Practice): Score {
  let [points, streak, longest] = [0, 0, 0];
  for (const { took_ms } of laps) {
    streak = took_ms <= PAR_MS ? streak + 1 : 0;
    longest = Math.max(longest, streak);
    points += Math.round(POINTS * Math.min(1, PAR_MS / took_ms)) + bonusOf(streak);
  }
  return {
    points,
    most: Array.from({ length: total }, (_, i) => POINTS + bonusOf(i + 1)).reduce((sum, one) => sum + one, 0),
    total,
    streak,
    longest,
    underPar: laps.filter((lap) => lap.took_ms <= PAR_MS).length,
    took_ms: laps.reduce((sum, lap) => sum + lap.took_ms, 0),
    par_ms: total * PAR_MS,
    isWhole: laps.length === total,
  };
}

function bonusOf(streak: number): number {
  return Math.min(MOST_BONUS, BONUS * Math.max(0, streak - 1));
}
