// A kiosk's screen does not go dark; the browser takes the lock back whenever the page is hidden.
import { useEffect } from "preact/hooks";

export function useAwakeScreen(): void {
  useEffect(() => {
    const keepAwake = (): void => {
      // Without a secure context there is no `wakeLock`, whatever its type says.
      const lock = (navigator as Partial<Navigator>).wakeLock;
      if (document.visibilityState === "visible") lock?.request("screen").catch(() => undefined);
    };
    keepAwake();
    document.addEventListener("visibilitychange", keepAwake);
    return () => document.removeEventListener("visibilitychange", keepAwake);
  }, []);
}
