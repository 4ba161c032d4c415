import { describe, expect, it } from "vitest";
import { adviceOf, type Judged } from "./advice";
import { adviceDe } from "./advice_de";
import { adviceEn } from "./advice_en";
import { adviceZh } from "./advice_zh";
import { de } from "./de";
import { en } from "./en";
import { zh } from "./zh";

const BLURRED: Judged = {
  verdict: "FAIL",
  margin: -1,
  advice: "pose-03.png and 2 more are blurred. Take them again.",
  reason: "edge_width_px",
  facts: { views: ["05 pose-03.png"], more: 2 },
};

describe("the advice of a measurement", () => {
  it("names what is wrong and what to do in each language", () => {
    expect(adviceOf(BLURRED, "en", en).all).toBe(
      "Blurred: Pose 3, 2 more. Take again: Pose 3, 2 more. Hold the board still, shorten the exposure, or keep it further away.",
    );
    expect(adviceOf(BLURRED, "de", de).wrong).toBe("Unscharf: Pose 3, 2 weitere.");
  });

  it("says what is good of a PASS, and what would help near the limit", () => {
    expect(adviceOf({ ...BLURRED, verdict: "PASS" }, "de", de).all).toBe("Jede Ansicht ist scharf.");
    const close = adviceOf({ ...BLURRED, verdict: "MARGINAL", margin: 0.1 }, "de", de);
    expect(close.all).toMatch(/^Angenommen, aber mit wenig Spielraum\. Noch einmal aufnehmen/);
    expect(close.wrong).toBe("");
  });

  it("says what is wrong of a value beyond its limit that costs a clean PASS only", () => {
    const refused = {
      ...BLURRED,
      verdict: "MARGINAL",
      reason: "refused_images",
      facts: { views: ["a.jpg"] },
    };
    expect(adviceOf(refused, "en", en).wrong).toBe("Not used: a.jpg.");
  });

  it("stays as the service said it for a code that is not known, and for a result without one", () => {
    for (const reason of ["brand_new", null]) {
      const said = adviceOf({ ...BLURRED, reason }, "de", de);
      expect([said.all, said.lang]).toEqual([BLURRED.advice, "en"]);
    }
  });

  it.each(Object.keys(adviceEn) as (keyof typeof adviceEn)[])("is whole for %s", (reason) => {
    const facts = {
      views: ["a.png", ""],
      poses: [1, 2],
      more: 1,
      count: 3,
      of: 4,
      quadrant: "top-left",
      lens: "x",
      bend: 0.2,
      share: 0.5,
      sku: "y",
      units: 60,
      parameter: "fx",
      deviations: 5.1,
      taken: 9,
      not_needed: 3,
    };
    for (const [language, say] of [
      ["en", en],
      ["de", de],
      ["zh", zh],
    ] as const) {
      for (const verdict of ["PASS", "FAIL"]) {
        const isReported = !("bad" in adviceEn[reason]);
        if (isReported && verdict === "FAIL") continue;
        const { all } = adviceOf({ ...BLURRED, verdict, reason, facts }, language, say);
        expect(all).not.toMatch(/undefined|NaN|\?(?! *\))|^\s*$/);
        expect(all).toMatch(/[.。]$/);
      }
    }
    for (const other of [adviceDe, adviceZh]) {
      expect(Object.keys(other[reason])).toEqual(Object.keys(adviceEn[reason]));
    }
  });
});
