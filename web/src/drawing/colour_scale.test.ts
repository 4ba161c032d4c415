import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { inkOn, mixed, rgbOf, STOPS, type Rgb } from "./colour_scale";

const css = readFileSync(new URL("../look/tokens.css", import.meta.url), "utf8");
const stops: Rgb[] = Array.from({ length: STOPS }, (_, i) => {
  const hex = new RegExp(`--heat-${i}: #(\\w{6});`).exec(css)?.[1] ?? expect.fail(`no --heat-${i}`);
  const part = (at: number): number => parseInt(hex.slice(at, at + 2), 16);
  return [part(0), part(2), part(4)];
});

const linear = (part: number): number =>
  part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4;

function luminance([r, g, b]: Rgb): number {
  return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
}

/** CIE L*: what the eye takes for even steps. */
function lightness(colour: Rgb): number {
  return 116 * Math.cbrt(luminance(colour)) - 16;
}

describe("the scale of heat maps", () => {
  it("gets lighter in even steps, so that it is read without its colours", () => {
    const steps = stops.slice(1).map((stop, i) => lightness(stop) - lightness(stops[i] ?? stop));
    expect(Math.min(...steps)).toBeGreaterThan(5);
    expect(Math.max(...steps)).toBeLessThan(11);
    expect(lightness(stops[STOPS - 1] ?? [0, 0, 0]) - lightness(stops[0] ?? [0, 0, 0])).toBeGreaterThan(70);
  });

  it("mixes between its stops and holds its ends", () => {
    const three: Rgb[] = [
      [0, 0, 0],
      [100, 50, 0],
      [200, 50, 100],
    ];
    expect(mixed(three, 0.25)).toEqual([50, 25, 0]);
    expect(mixed(three, 0.75)).toEqual([150, 50, 50]);
    expect(mixed(three, 1)).toEqual([200, 50, 100]);
    expect(mixed(three, -1)).toEqual([0, 0, 0]);
    expect(mixed(three, 7)).toEqual([200, 50, 100]);
  });

  it("has numbers on every colour that can be read (WCAG AA, 4.5)", () => {
    for (let share = 0; share <= 1; share += 0.01) {
      const ground = mixed(stops, share);
      const [dark, light] = [luminance(ground), inkOn(ground) === "#000000" ? 0 : 1].sort((a, b) => a - b);
      expect(((light ?? 0) + 0.05) / ((dark ?? 0) + 0.05)).toBeGreaterThanOrEqual(4.5);
    }
  });

  it("reads colours as browsers compute them", () => {
    expect(rgbOf("rgb(254, 232, 56)")).toEqual([254, 232, 56]);
  });
});
