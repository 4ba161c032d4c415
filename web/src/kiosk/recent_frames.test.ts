import { describe, expect, it } from "vitest";
import { RecentFrames, type FullFrame } from "./recent_frames";

function frame(sequence: number): FullFrame {
  return { sequence, width: 1, height: 1, at_ms: 0, serial: "VIN-1", grey: Uint8Array.of(sequence) };
}

describe("recent frames", () => {
  it("give back the very frame that was judged, and only while it is recent", () => {
    const recent = new RecentFrames(3);
    for (const sequence of [1, 2, 3, 4]) recent.keep(frame(sequence));

    expect(recent.find(1)).toBeNull();
    expect(recent.find(2)?.grey[0]).toBe(2);
    expect(recent.find(4)?.grey[0]).toBe(4);
  });

  it("of the last vehicle are forgotten", () => {
    const recent = new RecentFrames(3);
    recent.keep(frame(1));
    recent.forget();

    expect(recent.find(1)).toBeNull();
  });
});
