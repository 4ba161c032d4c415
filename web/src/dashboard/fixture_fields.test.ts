import { describe, expect, it } from "vitest";
import type { Problem } from "../api/problem";
import type { FixtureDocument } from "../generated/api";
import { fixtureOf, isOfFields, POINTERS, textsOf, wrongAt } from "./fixture_fields";

const fixture: FixtureDocument = {
  target: "chessboard:9x6:40mm",
  pose: { rvec: [1.2091995761561452, -1.21, 0], tvec: [1.62, 0.1 + 0.2, -1.14] },
  translation_sd_mm: 0.2,
  rotation_sd_mdeg: 20,
};

describe("the form of a fixture", () => {
  it("shows millimetres and degrees", () => {
    expect(textsOf(fixture)).toEqual({
      target: "chessboard:9x6:40mm",
      position: ["1620", "300", "-1140"],
      rotation: ["69.282032", "-69.327893", "0"],
      translationSd: "0.2",
      rotationSd: "20",
    });
  });

  it("gives back what it was given, to the last digit", () => {
    expect(fixtureOf(textsOf(fixture), fixture)).toEqual(fixture);
  });

  it("takes what is typed in metres and radians", () => {
    const texts = textsOf(fixture);
    texts.position[2] = "250.5";
    texts.rotation[0] = "180";
    const { pose } = fixtureOf(texts, fixture);
    expect(pose.tvec).toEqual([1.62, 0.1 + 0.2, 0.2505]);
    expect(pose.rvec[0]).toBeCloseTo(Math.PI, 12);
    expect(pose.rvec[1]).toBe(-1.21);
  });

  it("is empty without a fixture", () => {
    expect(
      Object.values(textsOf(null))
        .flat()
        .every((text) => text === ""),
    ).toBe(true);
  });
});

describe("a problem", () => {
  const errors = [{ pointer: POINTERS.position(1), detail: "is no number" }];
  const problem: Problem = { status: 422, code: "", title: "", detail: "", errors, traceId: null };

  it("is told at its field", () => {
    expect(wrongAt(problem, "/fixture/pose/tvec/1")).toBe("is no number");
    expect(wrongAt(problem, POINTERS.target)).toBeNull();
    expect(wrongAt(null, POINTERS.target)).toBeNull();
    expect(isOfFields(problem)).toBe(true);
  });

  it("that is about something else is told above the form", () => {
    expect(isOfFields({ ...problem, errors: [] })).toBe(false);
    expect(isOfFields({ ...problem, errors: [...errors, { pointer: "/fixture", detail: "" }] })).toBe(false);
  });
});
