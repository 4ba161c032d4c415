import { describe, expect, it } from "vitest";
import { de } from "./de";
import { en } from "./en";
import { firstLanguage, languageAt, nextLanguage } from "./language";
import { zh } from "./zh";
import { gateName, measurementName, purposeName } from "./measurements";

describe("the first language", () => {
  it("is the one that was chosen by hand", () => {
    expect(firstLanguage("de", ["en-US"])).toBe("de");
  });

  it("is else the first of the browser's that there is", () => {
    expect(firstLanguage(null, ["fr-FR", "de-AT", "en"])).toBe("de");
  });

  it("is Chinese for any Chinese of the browser", () => {
    expect(firstLanguage(null, ["zh-Hans-CN", "en"])).toBe("zh");
  });

  it("is else English, also when something odd was stored", () => {
    expect(firstLanguage("xx", ["fr"])).toBe("en");
  });
});

describe("at a station", () => {
  it("is the station's, unless somebody switched or the station has none", () => {
    expect(languageAt("zh", false, "en")).toBe("zh");
    expect(languageAt("zh", true, "en")).toBe("en");
    expect(languageAt(null, false, "de")).toBe("de");
    expect(languageAt("of-a-newer-service", false, "de")).toBe("de");
  });

  it("goes round all of them by one button", () => {
    expect([nextLanguage("en"), nextLanguage("de"), nextLanguage("zh")]).toEqual(["de", "zh", "en"]);
  });
});

describe("texts", () => {
  it("are none of them empty", () => {
    for (const words of [en, de, zh]) {
      for (const [name, text] of Object.entries(words)) {
        if (typeof text === "string") expect(text, name).not.toBe("");
      }
    }
  });

  it("of each language say as much as the English ones", () => {
    for (const words of [de, zh]) expect(Object.keys(words).sort()).toEqual(Object.keys(en).sort());
  });

  it("name measurements in each language, and unknown ones as they come", () => {
    expect(measurementName("coverage", "de")).toBe("Abdeckung der Zone");
    expect(measurementName("coverage", "zh")).toBe("工作区覆盖");
    expect(measurementName("brand_new_px", "en")).toBe("brand new px");
    expect(gateName("fit", de)).toBe("Anpassung");
    expect(gateName("brand-new", de)).toBe("brand-new");
    expect(purposeName("retest", en)).toBe("Retest");
  });
});
