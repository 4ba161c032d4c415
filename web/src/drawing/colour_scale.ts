// The scale of heat maps: ten colours of tokens.css, even in lightness, told apart by everyone (Cividis).
import type { Colours } from "./drawing";

export type Rgb = readonly [number, number, number];

export const STOPS = 10;

/** The numbers of a colour as a browser computes it, such as rgb(0, 34, 78). */
export function rgbOf(colour: string): Rgb {
  const [r = 0, g = 0, b = 0] = (colour.match(/[\d.]+/g) ?? []).map(Number);
  return [r, g, b];
}

/** The colour at a share 0…1 of the scale; beyond its ends that of the end. */
export function mixed(stops: readonly Rgb[], share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const low = stops[Math.floor(at)] ?? [0, 0, 0];
  const high = stops[Math.ceil(at)] ?? low;
  const part = at - Math.floor(at);
  const mix = (i: 0 | 1 | 2): number => Math.round(low[i] + (high[i] - low[i]) * part);
  return [mix(0), mix(1), mix(2)];
}

export function heatStops(colours: Colours): Rgb[] {
  return Array.from({ length: STOPS }, (_, i) => rgbOf(colours(`heat-${i}`)));
}

export function cssOf([r, g, b]: Rgb): string {
  return `rgb(${r} ${g} ${b})`;
}

/** Black or white, whichever is read better on a colour. */
export function inkOn([r, g, b]: Rgb): "#000000" | "#ffffff" {
  const [x = 0, y = 0, z = 0] = [r, g, b].map((part) => (part / 255) ** 2.2);
  // At this luminance black and white have the same contrast.
  return 0.2126 * x + 0.7152 * y + 0.0722 * z > 0.179 ? "#000000" : "#ffffff";
}
