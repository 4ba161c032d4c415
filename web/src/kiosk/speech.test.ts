import { describe, expect, it } from "vitest";
import { NOTHING_PENDING, paceSpeech } from "./speech";

type Look = [at_ms: number, text: string | null, isSpeaking?: boolean];

function said(...looks: Look[]): [number, string][] {
  let pending = NOTHING_PENDING;
  const heard: [number, string][] = [];
  for (const [at_ms, text, isSpeaking = false] of looks) {
    const paced = paceSpeech(pending, text, at_ms, isSpeaking);
    pending = paced.pending;
    if (paced.say !== null) heard.push([at_ms, paced.say]);
  }
  return heard;
}

describe("the voice", () => {
  it("says an instruction once, after it has stood for a moment", () => {
    expect(said([0, "left"], [300, "left"], [600, "left"], [900, "left"], [9000, "left"])).toEqual([
      [600, "left"],
    ]);
  });

  it("says nothing of what flickers by, and does not repeat itself after it", () => {
    expect(said([0, "left"], [600, "left"], [700, "up"], [900, "left"], [2000, "left"])).toEqual([
      [600, "left"],
    ]);
  });

  it("never speaks over itself: the newest one that stands waits until the voice is free", () => {
    expect(
      said(
        [0, "left"],
        [600, "left"],
        [700, "up"],
        [1400, "up", true],
        [1500, "closer", true],
        [2200, "closer"],
      ),
    ).toEqual([
      [600, "left"],
      [2200, "closer"],
    ]);
  });

  it("says an instruction again after another one was said", () => {
    expect(
      said([0, "left"], [600, "left"], [700, "hold"], [1300, "hold"], [1400, "left"], [2000, "left"]),
    ).toHaveLength(3);
  });

  it("is silent where there is nothing to say", () => {
    expect(said([0, null], [5000, null])).toEqual([]);
  });
});
