// The whole screen for as long as something shows, where the browser lets a page have it.
import { useEffect } from "preact/hooks";

/** `onLeft` is called when somebody leaves the full screen, as by Esc. */
export function useFullScreen(onLeft: () => void): void {
  useEffect(() => {
    const look = (): void => {
      if (document.fullscreenElement === null) onLeft();
    };
    document.addEventListener("fullscreenchange", look);
    return () => document.removeEventListener("fullscreenchange", look);
  }, [onLeft]);
  useEffect(() => {
    // A browser that refuses leaves the page as it is: what shows fills the window then.
    const page = document.documentElement as Partial<HTMLElement>;
    page.requestFullscreen?.({ navigationUI: "hide" }).catch(() => undefined);
    return () => {
      if (document.fullscreenElement !== null) document.exitFullscreen().catch(() => undefined);
    };
  }, []);
}
