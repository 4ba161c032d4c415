import { describe, expect, it } from "vitest";
import { de } from "../words/de";
import { en } from "../words/en";
import type { HintCode } from "./mirror";
import { hintText, problemText, remedyOf } from "./said";

const HINTS: HintCode[] = [
  "move-left",
  "move-right",
  "move-up",
  "move-down",
  "move-closer",
  "move-away",
  "tilt-top-back",
  "tilt-top-forward",
  "turn-left-back",
  "turn-right-back",
  "rotate-clockwise",
  "rotate-counterclockwise",
  "turn-upside-down",
  "hold-still",
  "hold",
  "show-board",
  "show-whole-board",
  "more-light",
  "less-light",
  "wrong-board",
];

describe.each([
  ["English", en],
  ["German", de],
])("in %s", (_, say) => {
  it.each(HINTS)("%s is said in words of which one matters most", (code) => {
    expect(hintText(code, say)).toMatch(/^[^*]*\*[^*]+\*[^*]*$/);
  });

  it("no two instructions read the same", () => {
    expect(new Set(HINTS.map((code) => hintText(code, say))).size).toBe(HINTS.length);
  });

  it("every gate that can fail says what to do", () => {
    for (const gate of ["frame", "sharpness", "poses", "fit", "certainty", "bias", "model", "score"]) {
      expect(remedyOf(gate, say), gate).not.toBeNull();
    }
  });
});

describe("a problem", () => {
  it("is said in the language where it is known", () => {
    const said = problemText({ code: "source-stalled", title: "No picture", detail: "…" }, de);

    expect(said.title).toBe("Von der Kamera kommt kein Bild");
    expect(said.isTranslated).toBe(true);
  });

  it("of a picture says what it wants, in words without marks", () => {
    const told = { code: "picture-unfit", title: "Title", detail: "Detail", facts: { hint: "hold-still" } };

    expect(problemText(told, de)).toEqual({
      title: de.told_picture_unfit,
      detail: de.hint_hold_still.replaceAll("*", ""),
      isTranslated: true,
    });
    expect(problemText({ ...told, facts: {} }, en).detail).toBe(en.told_picture_unfit_do);
  });

  it("of an open run names the camera type to choose", () => {
    const told = { code: "other-sku-open", title: "Title", detail: "Detail", facts: { sku: "front" } };

    expect(problemText(told, de).detail).toContain("front wählen");
    expect(problemText(told, en).detail).toContain("Choose front");
  });

  it("that is not known stays as the service said it", () => {
    const told = { code: "brand-new", title: "Title", detail: "What to do." };

    expect(problemText(told, de)).toEqual({ title: "Title", detail: "What to do.", isTranslated: false });
  });

  it("of the kiosk's own camera says what to do about it", () => {
    const said = problemText({ code: "camera-denied", title: "", detail: "" }, en);

    expect(said).toMatchObject({ title: en.camera_title, detail: en.camera_denied });
  });

  it("of a scan in mid-run names the vehicle that is open", () => {
    expect(problemText({ code: "run-open-here", title: "", detail: "VIN-1" }, en).detail).toContain("VIN-1");
  });
});
