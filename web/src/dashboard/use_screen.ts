// The screen that the page is on: a window may be moved to another one, and zoomed.
import { useEffect, useState } from "preact/hooks";
import { nameOf, storedDensity, storeDensity } from "./screen_scale";

export interface Screen {
  /** Of the screen; device pixels per mm are kept under it. */
  name: string;
  /** Device pixels per CSS pixel. */
  ratio: number;
  /** Device pixels, as far as browsers tell: the zoom of the page is in it. */
  width: number;
  height: number;
}

function presentScreen(): Screen {
  const { screen, devicePixelRatio: ratio } = window;
  return {
    name: nameOf(screen),
    ratio,
    width: Math.round(screen.width * ratio),
    height: Math.round(screen.height * ratio),
  };
}

export function useScreen(): Screen {
  const [screen, setScreen] = useState(presentScreen);
  useEffect(() => {
    const look = (): void => {
      setScreen((before) => {
        const now = presentScreen();
        return JSON.stringify(now) === JSON.stringify(before) ? before : now;
      });
    };
    // A window that is moved to a screen of the same density tells nothing until it is used again.
    const events = ["resize", "focus", "pointerdown"] as const;
    for (const event of events) window.addEventListener(event, look);
    return () => {
      for (const event of events) window.removeEventListener(event, look);
    };
  }, []);
  return screen;
}

/** Device pixels per mm of a screen, null until it is measured; and the way to keep them. */
export function useDensity(screen: string): [number | null, (density: number) => void] {
  const [kept, setKept] = useState<{ screen: string; density: number } | null>(null);
  const keep = (density: number): void => {
    storeDensity(screen, density);
    setKept({ screen, density });
  };
  return [kept?.screen === screen ? kept.density : storedDensity(screen), keep];
}
