import { describe, expect, it } from "vitest";
import { isScanning, NO_SCAN, scanKey, type Scan } from "./scanner";

function lettersOf(serial: string): string[] {
  return [...Array.from(serial), "Enter"];
}

function type(keys: readonly string[], apart_ms: number): { scan: Scan; serial: string | null } {
  let scan = NO_SCAN;
  let serial: string | null = null;
  keys.forEach((key, i) => ({ scan, serial } = scanKey(scan, key, 1000 + i * apart_ms)));
  return { scan, serial };
}

describe("a scanner", () => {
  it("is told from a hand by its speed", () => {
    expect(type(lettersOf("VIN-0815"), 12).serial).toBe("VIN-0815");
    expect(type(lettersOf("VIN-0815"), 120).serial).toBeNull();
  });

  it("may press Shift between its letters", () => {
    expect(type(["Shift", "V", "Shift", "I", "n", "7", "Enter"], 8).serial).toBe("VIn7");
  });

  it("has ended after Enter: the next Enter scans nothing", () => {
    const { scan } = type(lettersOf("VIN-0815"), 12);

    expect(scanKey(scan, "Enter", 2000).serial).toBeNull();
  });

  it("does not take up letters that were typed by hand before it", () => {
    const byHand = scanKey(NO_SCAN, "x", 0).scan;
    let { scan } = scanKey(byHand, "A", 1400);
    for (const [i, key] of ["B", "1", "2"].entries()) ({ scan } = scanKey(scan, key, 1410 + 10 * i));

    expect(scanKey(scan, "Enter", 1445).serial).toBe("AB12");
  });

  it("that was held up gives nothing: half a serial would be another vehicle's", () => {
    let { scan } = scanKey(NO_SCAN, "V", 1000);
    for (const [i, key] of Array.from("IN-0815").entries()) ({ scan } = scanKey(scan, key, 1200 + 10 * i));

    expect(scanKey(scan, "Enter", 1275).serial).toBeNull();
  });

  it("is at work from its second letter on, so that a space in a serial captures nothing", () => {
    expect(isScanning({ ...NO_SCAN, letters: "A", at_ms: 0 }, 10)).toBe(false);
    expect(isScanning({ ...NO_SCAN, letters: "AB", at_ms: 0 }, 10)).toBe(true);
    expect(isScanning({ ...NO_SCAN, letters: "AB", at_ms: 0 }, 200)).toBe(false);
  });

  it("needs a few letters: a foot switch that is Enter scans nothing", () => {
    expect(type(["Enter"], 1).serial).toBeNull();
    expect(type(["a", "b", "Enter"], 1).serial).toBeNull();
  });
});
