import { describe, expect, it } from "vitest";
import { de } from "./de";
import { en } from "./en";
import { firstLanguage } from "./language";
import { gateName, measurementName, purposeName } from "./measurements";

describe("the first language", () => {
  it("is the one that was chosen by hand", () => {
    expect(firstLanguage("de", ["en-US"])).toBe("de");
  });

  it("is else the first of the browser's that there is", () => {
    expect(firstLanguage(null, ["fr-FR", "de-AT", "en"])).toBe("de");
  });

  it("is else English, also when something odd was stored", () => {
    expect(firstLanguage("xx", ["fr"])).toBe("en");
  });
});

describe("texts", () => {
  it("are none of them empty", () => {
    for (const words of [en, de]) {
      for (const [name, text] of Object.entries(words)) {
        if (typeof text === "string") expect(text, name).not.toBe("");
      }
    }
  });

  it("name measurements in both languages, and unknown ones as they come", () => {
    expect(measurementName("coverage", "de")).toBe("Abdeckung der Zone");
    expect(measurementName("brand_new_px", "en")).toBe("brand new px");
    expect(gateName("fit", de)).toBe("Anpassung");
    expect(gateName("brand-new", de)).toBe("brand-new");
    expect(purposeName("retest", en)).toBe("Retest");
  });
});
