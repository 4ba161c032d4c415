// Keys of the whole page: the scanner, which needs no focus, and the commands of the run.
import { useEffect } from "preact/hooks";
import { commandOf } from "./keys";
import type { Kiosk } from "./kiosk";
import { screenOf } from "./kiosk_state";
import { isScanning, NO_SCAN, scanKey } from "./scanner";

export function useKeys(kiosk: Kiosk): void {
  useEffect(() => {
    let scan = NO_SCAN;

    const press = (event: KeyboardEvent): void => {
      kiosk.wakeSound();
      // A field takes the letters itself, from a scanner as from hands, and shows what it took.
      if (event.target instanceof HTMLInputElement) return;
      const isScan = isScanning(scan, event.timeStamp);
      const read = scanKey(scan, event.key, event.timeStamp);
      scan = read.scan;
      if (read.serial !== null) {
        event.preventDefault();
        kiosk.begin(read.serial);
        return;
      }
      if (!isScan) command(kiosk, event);
    };
    const wake = (): void => kiosk.wakeSound();

    window.addEventListener("keydown", press);
    window.addEventListener("pointerdown", wake);
    return () => {
      window.removeEventListener("keydown", press);
      window.removeEventListener("pointerdown", wake);
    };
  }, [kiosk]);
}

function command(kiosk: Kiosk, event: KeyboardEvent): void {
  if (event.key === "Escape" && kiosk.question.value !== null) {
    // The browser closes a dialog a moment later, and a key pressed meanwhile would be lost.
    event.preventDefault();
    kiosk.question.value = null;
    return;
  }
  const press = {
    key: event.key,
    isRepeated: event.repeat,
    isModified: event.ctrlKey || event.altKey || event.metaKey,
    isOnControl: event.target instanceof Element && event.target.closest("button, input, select, a") !== null,
  };
  const asked = commandOf(press, screenOf(kiosk.state.value), kiosk.question.value !== null);
  if (asked === null) return;
  event.preventDefault();
  if (asked === "capture") kiosk.capture();
  else if (asked === "undo") kiosk.undo();
  else if (asked === "figures") kiosk.figures.value = !kiosk.figures.value;
  else kiosk.question.value = { kind: "abort" };
}
