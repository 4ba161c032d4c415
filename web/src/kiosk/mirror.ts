// What a mirrored display changes: pictures, arrows and words swap left and right, and so do turns in the image.
import type { HintSaid } from "../generated/protocol";

export type HintCode = HintSaid["code"];

const SWAPPED: Partial<Record<HintCode, HintCode>> = {
  "move-left": "move-right",
  "move-right": "move-left",
  "turn-left-back": "turn-right-back",
  "turn-right-back": "turn-left-back",
  "rotate-clockwise": "rotate-counterclockwise",
  "rotate-counterclockwise": "rotate-clockwise",
};

/** The instruction as it reads on the display. */
export function hintOnDisplay(code: HintCode, mirrored: boolean): HintCode {
  return mirrored ? (SWAPPED[code] ?? code) : code;
}

const STORED_AS = "dmscal.kiosk.mirrored";

/** Stations differ in where the camera sits, so each remembers its own. */
export function isMirrored(station: string): boolean {
  return localStorage.getItem(`${STORED_AS}.${station}`) === "true";
}

export function rememberMirrored(station: string, mirrored: boolean): void {
  localStorage.setItem(`${STORED_AS}.${station}`, String(mirrored));
}
