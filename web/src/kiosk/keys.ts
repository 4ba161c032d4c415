// Which key does what. A foot switch is a key: it sends space or Enter.
import type { Screen } from "./kiosk_state";

export type Command = "capture" | "undo" | "abort" | "figures";

export interface Press {
  key: string;
  isRepeated: boolean;
  /** Ctrl, Alt or Meta is held: a key of the browser, not of the kiosk. */
  isModified: boolean;
  /** A button or field has the focus, which needs space and Enter itself. */
  isOnControl: boolean;
}

/** Keys that no button needs for itself. */
const ANYWHERE: ReadonlySet<Command> = new Set(["abort", "figures"]);

const COMMANDS: Readonly<Record<string, Command>> = {
  " ": "capture",
  Enter: "capture",
  Backspace: "undo",
  Escape: "abort",
  F2: "figures",
};

export function commandOf(press: Press, screen: Screen, isAsking: boolean): Command | null {
  if (screen !== "guide" || isAsking || press.isRepeated || press.isModified) return null;
  const command = COMMANDS[press.key] ?? null;
  return press.isOnControl && command !== null && !ANYWHERE.has(command) ? null : command;
}
