import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

const css = readFileSync(new URL("./tokens.css", import.meta.url), "utf8");

function token(name: string, scheme: "light" | "dark"): string {
  const value = new RegExp(`--${name}:\\s*([^;]+);`).exec(css)?.[1] ?? expect.fail(`no token ${name}`);
  const pair = /light-dark\((#\w+), (#\w+)\)/.exec(value);
  return (scheme === "light" ? pair?.[1] : pair?.[2]) ?? value;
}

/** Relative luminance of WCAG 2. */
function luminance(colour: string): number {
  const [r = 0, g = 0, b = 0] = [1, 3, 5]
    .map((at) => parseInt(colour.slice(at, at + 2), 16) / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [high = 0, low = 0] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (high + 0.05) / (low + 0.05);
}

const TEXT_ON_GROUND = [
  ["ink", "paper"],
  ["ink", "panel"],
  ["ink", "pass-tint"],
  ["ink", "marginal-tint"],
  ["ink", "fail-tint"],
  ["muted", "paper"],
  ["muted", "panel"],
  ["muted", "marginal-tint"],
  ["muted", "fail-tint"],
  ["accent", "panel"],
  ["accent", "accent-ground"],
  ["pass", "panel"],
  ["marginal", "panel"],
  ["marginal", "marginal-tint"],
  ["fail", "panel"],
  ["fail", "fail-tint"],
  ["idle", "panel"],
  ["plot-point", "panel"],
  ["plot-chosen", "panel"],
  ["plot-ring", "panel"],
  ["bar-ink", "bar"],
  ["bar-muted", "bar"],
  ["pass-on-ground", "pass-ground"],
  ["marginal-on-ground", "marginal-ground"],
  ["fail-on-ground", "fail-ground"],
  ["idle-on-ground", "idle-ground"],
] as const;

describe.each(["light", "dark"] as const)("in the %s scheme", (scheme) => {
  it.each(TEXT_ON_GROUND)("%s can be read on %s (WCAG AA, 4.5)", (text, ground) => {
    expect(contrast(token(text, scheme), token(ground, scheme))).toBeGreaterThanOrEqual(4.5);
  });
});

it("the two ends of grey have the contrast of 21 that WCAG gives them", () => {
  expect(contrast("#000000", "#ffffff")).toBeCloseTo(21, 6);
});
