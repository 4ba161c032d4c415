// Loading something for as long as a component shows it: again by the clock, again after an outage.
import { useEffect, useState } from "preact/hooks";
import { recoveries } from "./connection";
import { meansUnreachable, RequestFailed, type Problem } from "./problem";

export type Resource<T> =
  { state: "loading" } | { state: "ready"; value: T } | { state: "failed"; problem: Problem };

const LOADING = { state: "loading" } as const;

function never(): null {
  return null;
}

const RETRY_MS = 5000;

/**
 * `load` decides what is loaded: pass the same function for the same thing (useCallback). `again` says in how many
 * ms it is loaded again, or null for never; a function that stays the same, too.
 * What was loaded stays on show while it is refreshed and while the service is away.
 */
export function useResource<T>(
  load: (signal: AbortSignal) => Promise<T>,
  again: (value: T) => number | null = never,
): Resource<T> {
  const [held, setHeld] = useState<{ load: unknown; resource: Resource<T> }>({ load, resource: LOADING });
  const recovered = recoveries.value;

  useEffect(() => {
    const abort = new AbortController();
    let timer: number | undefined;

    const show = (resource: Resource<T>): void => setHeld({ load, resource });
    const round = async (): Promise<void> => {
      try {
        const value = await load(abort.signal);
        if (abort.signal.aborted) return;
        show({ state: "ready", value });
        wait(again(value));
      } catch (error) {
        if (abort.signal.aborted) return;
        if (!(error instanceof RequestFailed)) throw error;
        // Out of reach: what is on show stays, and `recoveries` starts a new round.
        if (meansUnreachable(error.problem)) return;
        show({ state: "failed", problem: error.problem });
        wait(RETRY_MS);
      }
    };
    const wait = (ms: number | null): void => {
      if (ms !== null) timer = window.setTimeout(() => void round(), ms);
    };

    void round();
    return () => {
      abort.abort();
      window.clearTimeout(timer);
    };
  }, [load, again, recovered]);

  return held.load === load ? held.resource : LOADING;
}
