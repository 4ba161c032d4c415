// Times a practice by what the kiosk is told.
import { effect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Kiosk } from "./kiosk";
import { followRun } from "./practice";

export function usePractice(kiosk: Kiosk): void {
  useEffect(
    () =>
      effect(() => {
        const { run, live } = kiosk.state.value;
        kiosk.practice.value = followRun(kiosk.practice.peek(), run, live !== null, performance.now());
      }),
    [kiosk],
  );
}
