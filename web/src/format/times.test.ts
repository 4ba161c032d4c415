import { describe, expect, it } from "vitest";
import { longDay, shortDay, when } from "./times";

describe("times", () => {
  const now = new Date(2026, 10, 22, 15, 0);

  it("of today are a clock", () => {
    expect(when(new Date(2026, 10, 22, 7, 5).toISOString(), now, "en-GB")).toBe("07:05");
  });

  it("of other days have their date", () => {
    expect(when(new Date(2026, 10, 21, 7, 5).toISOString(), now, "en-GB")).toBe("21 Nov 2026, 07:05");
  });

  it("just after midnight are not written as hour 24", () => {
    expect(when(new Date(2026, 10, 22, 0, 5).toISOString(), now, "en")).toBe("00:05");
  });

  it("of the service's calendar are the same day in every zone", () => {
    expect(shortDay("2026-03-01", "en-GB")).toBe("01 Mar");
    expect(longDay("2026-03-01", "en-GB")).toBe("Sun, 01 Mar 2026");
  });
});
