// A fixture as the texts of a form, in mm and degrees, and back; and which field a problem is about. Pure.
import type { Problem } from "../api/problem";
import type { FixtureDocument } from "../generated/api";

export const AXES = ["x", "y", "z"] as const;

/** By field what stands in it. */
export interface FixtureTexts {
  target: string;
  position: [string, string, string];
  rotation: [string, string, string];
  translationSd: string;
  rotationSd: string;
}

const DEGREE = Math.PI / 180;
const MM = 1e-3;
/** Digits after the mark that are shown of a length in mm and of an angle in degrees. */
const DIGITS = 6;

export function textsOf(fixture: FixtureDocument | null): FixtureTexts {
  if (fixture === null) {
    const none: [string, string, string] = ["", "", ""];
    return { target: "", position: none, rotation: none, translationSd: "", rotationSd: "" };
  }
  const { pose } = fixture;
  return {
    target: fixture.target,
    position: each(pose.tvec, (length) => text(length / MM)),
    rotation: each(pose.rvec, (angle) => text(angle / DEGREE)),
    translationSd: text(fixture.translation_sd_mm),
    rotationSd: text(fixture.rotation_sd_mdeg),
  };
}

/** What was not typed anew keeps its number to the last digit: another number is another fixture. */
export function fixtureOf(texts: FixtureTexts, before: FixtureDocument | null): FixtureDocument {
  const shown = textsOf(before);
  return {
    target: texts.target.trim(),
    pose: {
      tvec: each([0, 1, 2] as const, (i) =>
        number(texts.position[i], shown.position[i], before?.pose.tvec[i], MM),
      ),
      rvec: each([0, 1, 2] as const, (i) =>
        number(texts.rotation[i], shown.rotation[i], before?.pose.rvec[i], DEGREE),
      ),
    },
    translation_sd_mm: Number(texts.translationSd),
    rotation_sd_mdeg: Number(texts.rotationSd),
  };
}

/** The pointers at which the service tells what is wrong with a field. */
export const POINTERS = {
  target: "/fixture/target",
  position: (axis: number) => `/fixture/pose/tvec/${axis}`,
  rotation: (axis: number) => `/fixture/pose/rvec/${axis}`,
  translationSd: "/fixture/translation_sd_mm",
  rotationSd: "/fixture/rotation_sd_mdeg",
};

const ALL_POINTERS: ReadonlySet<string> = new Set([
  POINTERS.target,
  ...AXES.map((_, i) => POINTERS.position(i)),
  ...AXES.map((_, i) => POINTERS.rotation(i)),
  POINTERS.translationSd,
  POINTERS.rotationSd,
]);

/** What is said at a field; null: nothing. */
export function wrongAt(problem: Problem | null, pointer: string): string | null {
  return problem?.errors.find((error) => error.pointer === pointer)?.detail ?? null;
}

/** Whether a problem is told by fields alone, so that it need not be told again above the form. */
export function isOfFields(problem: Problem): boolean {
  return problem.errors.length > 0 && problem.errors.every(({ pointer }) => ALL_POINTERS.has(pointer));
}

function each<T, U>([a, b, c]: readonly [T, T, T], make: (value: T) => U): [U, U, U] {
  return [make(a), make(b), make(c)];
}

function text(value: number): string {
  return String(Number(value.toFixed(DIGITS)));
}

function number(
  typed: string | undefined,
  shown: string | undefined,
  before: number | undefined,
  unit: number,
): number {
  return before !== undefined && typed === shown ? before : Number(typed) * unit;
}
