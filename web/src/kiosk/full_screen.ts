// The whole screen for the kiosk, where the browser lets a page have it.
import { signal } from "@preact/signals";

/** Of Chromium only. */
interface Keyboard {
  lock: (keys: readonly string[]) => Promise<void>;
}

/** Not every browser has it, whatever its types say. */
const page = document as Partial<Document>;

export const hasFullScreen = page.fullscreenEnabled === true;
export const isFullScreen = signal(page.fullscreenElement !== null && page.fullscreenElement !== undefined);

document.addEventListener("fullscreenchange", () => {
  isFullScreen.value = document.fullscreenElement !== null;
});

export function toggleFullScreen(): void {
  // A browser that refuses stays as it is, and so does the switch.
  if (isFullScreen.value) document.exitFullscreen().catch(() => undefined);
  else enter().catch(() => undefined);
}

async function enter(): Promise<void> {
  await document.documentElement.requestFullscreen({ navigationUI: "hide" });
  // Else Esc would leave the full screen instead of asking whether to abort; held down, it still does.
  await (navigator as Navigator & { keyboard?: Keyboard }).keyboard?.lock(["Escape"]);
}
