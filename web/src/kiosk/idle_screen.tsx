// Over the start screen while nobody is there: calm, dark, and it says what to do. The field under it keeps the
// focus, so that a scan that wakes it loses no letter.
import { type JSX } from "preact";
import { words } from "../words/language";
import type { Kiosk } from "./kiosk";

export function IdleScreen({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const say = words.value;
  if (!kiosk.isIdle.value) return null;
  const wake = (): void => {
    kiosk.isIdle.value = false;
    document.querySelector<HTMLInputElement>(".serial-field")?.focus();
  };
  return (
    <div class="idle" role="status" onClick={wake}>
      <svg class="idle-sign" viewBox="0 0 240 120" aria-hidden="true">
        <path d="M14 20 V8 H40 M200 8 H226 V20 M226 100 V112 H200 M40 112 H14 V100" />
        <path
          class="idle-bars"
          d="M36 28 V92 M52 28 V92 M64 28 V92 M88 28 V92 M112 28 V92 M124 28 V92 M148 28 V92 M164 28 V92 M188 28 V92 M204 28 V92"
        />
        <path class="idle-ray" d="M6 60 H234" />
      </svg>
      <p class="idle-title">{say.idle_title}</p>
      <p class="idle-detail">{say.idle_detail}</p>
      <p class="idle-station">{kiosk.state.value.welcome?.name ?? kiosk.station}</p>
    </div>
  );
}
