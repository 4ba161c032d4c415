import { describe, expect, it } from "vitest";
import { densitiesFrom, fittingFactor, nameOf, scaledSpec, trueSize } from "./screen_scale";

describe("a target's size on a screen", () => {
  it("is made of whole pixels where that changes little, and said exactly", () => {
    const size = trueSize(25, 4.003);

    expect(size).toEqual({ factor: 100 / 100.075, pitchPx: 100, isWhole: true });
    expect(scaledSpec("chessboard:9x6:25mm", size.factor)).toBe("chessboard:9x6:24.9813mm");
  });

  it("stays as asked for where whole pixels would change it by half a percent or more", () => {
    expect(trueSize(5, 3.7)).toEqual({ factor: 1, pitchPx: 18.5, isWhole: false });
    expect(trueSize(25, 3.62)).toEqual({ factor: 1, pitchPx: 90.5, isWhole: false });
    expect(trueSize(0.01, 4)).toMatchObject({ factor: 1, isWhole: false });
  });

  it("changes every length of the words and nothing else", () => {
    expect(scaledSpec("charuco:11x8:20mm:15mm:4x4_50", 0.5)).toBe("charuco:11x8:10mm:7.5mm:4x4_50");
    expect(scaledSpec("chessboard:9x6:25mm", 1)).toBe("chessboard:9x6:25mm");
    expect(scaledSpec("chessboard:9x6:100mm", 1)).toBe("chessboard:9x6:100mm");
  });

  it("that fits has a pitch in tenths of a millimetre", () => {
    expect(25 * fittingFactor(25, 0.713)).toBeCloseTo(17.7, 9);
    expect(25 * fittingFactor(25, 0.8)).toBeCloseTo(19.9, 9);
    expect(fittingFactor(25, -0.2)).toBe(0);
    expect(fittingFactor(25, 0.001)).toBe(0);
  });
});

describe("what is kept of screens", () => {
  it("has a name for each that size and place make", () => {
    expect(nameOf({ width: 1920, height: 1080 })).toBe("1920x1080+0+0");
    expect(nameOf({ width: 1920, height: 1080, availLeft: 1920, availTop: 0 })).toBe("1920x1080+1920+0");
  });

  it.each([null, "", "7", "null", "{", '{"a": "4", "b": 0, "c": 1000, "d": null}'])(
    "is nothing where %j is stored",
    (stored) => {
      expect(densitiesFrom(stored)).toEqual({});
    },
  );

  it("is read back", () => {
    expect(densitiesFrom('{"1920x1080+0+0": 3.6}')).toEqual({ "1920x1080+0+0": 3.6 });
  });
});
