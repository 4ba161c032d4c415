// How large a device pixel of a screen is, as measured with a card or a ruler, and what that makes of a target's size.

/** ISO/IEC 7810 ID-1: bank cards, driving licences, most identity cards; mm. */
export const CARD = { width: 85.6, height: 53.98, radius: 3.18 } as const;
/** Device pixels per mm; beyond them somebody mistyped. */
export const LEAST_DENSITY = 1.2;
export const MOST_DENSITY = 40;
/** Squares are drawn a little larger or smaller where that makes them whole pixels. */
const MOST_CHANGE = 0.005;
const STORED_AS = "dmscal.screens";

/** As browsers tell it: `availLeft` and `availTop` are where the screen is among several, and not everywhere. */
export interface ScreenFacts {
  width: number;
  height: number;
  availLeft?: number;
  availTop?: number;
}

/** Browsers do not name screens: size and place tell one from another. */
export function nameOf({ width, height, availLeft = 0, availTop = 0 }: ScreenFacts): string {
  return `${width}x${height}+${availLeft}+${availTop}`;
}

export function isDensity(value: unknown): value is number {
  return typeof value === "number" && value >= LEAST_DENSITY && value <= MOST_DENSITY;
}

/** Device pixels per mm by the screens' names. */
export function densitiesFrom(stored: string | null): Record<string, number> {
  try {
    const held: unknown = JSON.parse(stored ?? "{}");
    if (typeof held !== "object" || held === null) return {};
    return Object.fromEntries(
      Object.entries(held).filter((entry): entry is [string, number] => isDensity(entry[1])),
    );
  } catch {
    return {};
  }
}

export function storedDensity(screen: string): number | null {
  return densitiesFrom(localStorage.getItem(STORED_AS))[screen] ?? null;
}

export function storeDensity(screen: string, density: number): void {
  const held = densitiesFrom(localStorage.getItem(STORED_AS));
  localStorage.setItem(STORED_AS, JSON.stringify({ ...held, [screen]: density }));
}

export interface TrueSize {
  /** By which the target is larger than asked for. */
  factor: number;
  /** From one square to the next, device pixels. */
  pitchPx: number;
  isWhole: boolean;
}

/** The size in which a target is drawn: whole pixels to a square where that changes it by less than half a percent. */
export function trueSize(pitchMm: number, density: number): TrueSize {
  const exact = pitchMm * density;
  const whole = Math.round(exact);
  const factor = whole / exact;
  if (whole < 1 || Math.abs(factor - 1) >= MOST_CHANGE) return { factor: 1, pitchPx: exact, isWhole: false };
  return { factor, pitchPx: whole, isWhole: true };
}

/** The words of the same target in another size: every length in them is `factor` times as large. */
export function scaledSpec(spec: string, factor: number): string {
  return spec.replace(/(\d+(?:\.\d+)?)mm/g, (_, length: string) => {
    const scaled = (Number(length) * factor).toFixed(4);
    return `${scaled.replace(/\.?0+$/, "")}mm`;
  });
}

/** The factor for the largest size within a share of a target's own: a pitch in whole tenths of a millimetre. */
export function fittingFactor(pitchMm: number, share: number): number {
  // Whole pixels may make it a little larger again.
  const most = pitchMm * share * (1 - MOST_CHANGE);
  return Math.max(0, Math.floor(most * 10 + 1e-9) / 10 / pitchMm);
}
