// The corners of a run's captures, loaded one after the other so that the page fills while they come.
import { useEffect, useState } from "preact/hooks";
import { getCapture } from "../api/client";
import { recoveries } from "../api/connection";
import { RequestFailed } from "../api/problem";
import type { Capture, CaptureDetail } from "../generated/api";

export type CaptureDetails = ReadonlyMap<string, CaptureDetail>;

/** `state` of the run: the solve of a finished run adds the reprojected corners, so they are loaded anew. */
export function useCaptureDetails(captures: readonly Capture[], state: string): CaptureDetails {
  const [details, setDetails] = useState<{ state: string; byId: CaptureDetails }>({ state, byId: new Map() });
  const recovered = recoveries.value;

  useEffect(() => {
    const abort = new AbortController();
    const byId = new Map(details.state === state ? details.byId : []);

    const loadAll = async (): Promise<void> => {
      for (const { id } of captures) {
        if (byId.has(id)) continue;
        byId.set(id, await getCapture(id, abort.signal));
        if (abort.signal.aborted) return;
        setDetails({ state, byId: new Map(byId) });
      }
    };
    loadAll().catch((error: unknown) => {
      // The page says already that the service is away or that the run is gone.
      if (!abort.signal.aborted && !(error instanceof RequestFailed)) throw error;
    });
    return () => abort.abort();
    // What was loaded before is only reused, it is no reason to load.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [captures, state, recovered]);

  return details.byId;
}
