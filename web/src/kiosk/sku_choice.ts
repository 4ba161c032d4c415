// Which camera type the next vehicle has: chosen once per station and remembered there.

const STORED_AS = "dmscal.kiosk.sku";

/** The one that was chosen if it is still offered, else the only one; null: it must be asked for. */
export function choose(stored: string | null, offered: readonly string[]): string | null {
  if (stored !== null && offered.includes(stored)) return stored;
  return offered.length === 1 ? (offered[0] ?? null) : null;
}

export function chosenSku(station: string, offered: readonly string[]): string | null {
  return choose(localStorage.getItem(`${STORED_AS}.${station}`), offered);
}

export function rememberSku(station: string, code: string): void {
  localStorage.setItem(`${STORED_AS}.${station}`, code);
}
