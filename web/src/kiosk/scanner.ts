// A scanner types like a keyboard, only faster than hands: its letters come at once and end with Enter.

/** Letters further apart than this are typed by hand. */
const FASTEST_HAND_MS = 80;
/** Letters so close before a scan may be its own beginning, held up somewhere: half a serial is worse than none. */
const SAME_SCAN_MS = 1000;
const SHORTEST = 4;

export interface Scan {
  letters: string;
  at_ms: number;
  /** Letters may be missing at its beginning. */
  isBroken: boolean;
}

export const NO_SCAN: Scan = { letters: "", at_ms: Number.NEGATIVE_INFINITY, isBroken: false };

/** One more key; `serial` is what was scanned when this key ended a scan, else null. */
export function scanKey(scan: Scan, key: string, at_ms: number): { scan: Scan; serial: string | null } {
  const going = goOn(scan, at_ms);
  if (key === "Enter") {
    const serial = going.letters.trim();
    return { scan: NO_SCAN, serial: serial.length >= SHORTEST && !going.isBroken ? serial : null };
  }
  // Shift comes between the letters of a scan.
  if (key.length !== 1) return { scan: going.letters === "" ? going : { ...going, at_ms }, serial: null };
  return { scan: { ...going, letters: going.letters + key, at_ms }, serial: null };
}

function goOn(scan: Scan, at_ms: number): Scan {
  const apart_ms = at_ms - scan.at_ms;
  if (apart_ms <= FASTEST_HAND_MS) return scan;
  return { letters: "", at_ms: scan.at_ms, isBroken: apart_ms < SAME_SCAN_MS };
}

/** Whether this key belongs to letters that came as fast as a scanner's. */
export function isScanning(scan: Scan, at_ms: number): boolean {
  return scan.letters.length >= 2 && at_ms - scan.at_ms <= FASTEST_HAND_MS;
}
