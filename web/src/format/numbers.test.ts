import { describe, expect, it } from "vitest";
import { digitsForSd, fixed, percent, plain, signed, significant, withUnit } from "./numbers";

describe("numbers", () => {
  it("have the language's decimal mark and a real minus sign", () => {
    expect(fixed(-0.3774, 3, "en")).toBe("−0.377");
    expect(fixed(-0.3774, 3, "de")).toBe("−0,377");
  });

  it("are not grouped: 1350.12 stays one word", () => {
    expect(fixed(1350.123, 2, "en")).toBe("1350.12");
  });

  it("carry a sign where the direction counts", () => {
    expect(signed(0.25, 2, "en")).toBe("+0.25");
    expect(signed(-0.25, 2, "en")).toBe("−0.25");
  });

  it.each([
    [0.0000012, "1.2·10⁻⁶"],
    [-3.14e-12, "−3.1·10⁻¹²"],
    [0.000843, "0.000843"],
    [0.1634, "0.163"],
    [12.345, "12.3"],
    [1350.12, "1350"],
    [40, "40"],
    [0, "0"],
    [-0.0213, "−0.0213"],
  ])("show about three digits that count: %d as %s", (value, text) => {
    expect(significant(value, "en")).toBe(text);
  });

  it.each([null, undefined, Number.NaN, Number.POSITIVE_INFINITY])(
    "are a dash when there is none: %s",
    (value) => {
      expect(fixed(value, 2, "en")).toBe("–");
      expect(significant(value, "en")).toBe("–");
      expect(withUnit(fixed(value, 2, "en"), "px")).toBe("–");
    },
  );

  it("of limits are shown as they were written", () => {
    expect([plain(1e-9, "en"), plain(0.001, "en"), plain(1.02, "de"), plain(40, "en")]).toEqual([
      "1.0·10⁻⁹",
      "0.001",
      "1,02",
      "40",
    ]);
  });

  it("end where their uncertainty begins", () => {
    expect(digitsForSd(0.34)).toBe(2);
    expect(digitsForSd(0.0021)).toBe(4);
    expect(digitsForSd(12)).toBe(1);
    expect(digitsForSd(0)).toBe(4);
  });

  it("write shares in percent", () => {
    expect(percent(0.853, "en")).toBe("85 %");
  });
});
