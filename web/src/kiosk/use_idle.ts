// Lets the screen rest once nobody has touched anything for a while, and wakes it at the first key.
import { useEffect } from "preact/hooks";
import { IDLE_AFTER_MS, mayRest, onlyWakes } from "./idle";
import type { Kiosk } from "./kiosk";

const LOOK_MS = 1000;

export function useIdle(kiosk: Kiosk): void {
  useEffect(() => {
    let lively_ms = performance.now();
    const stir = (): void => {
      lively_ms = performance.now();
    };
    const press = (event: KeyboardEvent): void => {
      stir();
      if (!kiosk.isIdle.value) return;
      kiosk.isIdle.value = false;
      if (!onlyWakes(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
    };
    const look = (): void => {
      if (!mayRest(kiosk.state.value)) stir();
      kiosk.isIdle.value = performance.now() - lively_ms > IDLE_AFTER_MS;
      if (kiosk.isIdle.value) kiosk.isPractising.value = false;
    };
    const timer = window.setInterval(look, LOOK_MS);
    // Before any field or button hears of it.
    window.addEventListener("keydown", press, { capture: true });
    window.addEventListener("pointerdown", stir);
    return () => {
      window.clearInterval(timer);
      window.removeEventListener("keydown", press, { capture: true });
      window.removeEventListener("pointerdown", stir);
    };
  }, [kiosk]);
}
