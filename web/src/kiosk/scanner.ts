// A scanner types like a keyboard, only faster than hands: its letters come at once and end with Enter.

/** Letters further apart than this are typed by hand. */
const FASTEST_HAND_MS = 50;
const SHORTEST = 4;

export interface Scan {
  letters: string;
  at_ms: number;
}

export const NO_SCAN: Scan = { letters: "", at_ms: Number.NEGATIVE_INFINITY };

/** One more key; `serial` is what was scanned when this key ended a scan, else null. */
export function scanKey(scan: Scan, key: string, at_ms: number): { scan: Scan; serial: string | null } {
  const letters = at_ms - scan.at_ms <= FASTEST_HAND_MS ? scan.letters : "";
  if (key === "Enter") {
    const serial = letters.trim();
    return { scan: NO_SCAN, serial: serial.length >= SHORTEST ? serial : null };
  }
  // Shift comes between the letters of a scan.
  if (key.length !== 1) return { scan: letters === "" ? NO_SCAN : { letters, at_ms }, serial: null };
  return { scan: { letters: letters + key, at_ms }, serial: null };
}

/** Whether this key belongs to letters that came as fast as a scanner's. */
export function isScanning(scan: Scan, at_ms: number): boolean {
  return scan.letters.length >= 2 && at_ms - scan.at_ms <= FASTEST_HAND_MS;
}
