// The codes of all SKUs and stations, in the order of the alphabet, for choices.
import { allParts } from "../api/all_parts";
import { getSkus, getStations } from "../api/client";
import { useResource } from "../api/use_resource";

export interface Codes {
  skus: readonly string[];
  stations: readonly string[];
}

const NONE: Codes = { skus: [], stations: [] };

async function load(signal: AbortSignal): Promise<Codes> {
  const [skus, stations] = await Promise.all([
    allParts((cursor) => getSkus(cursor, signal)),
    allParts((cursor) => getStations(cursor, signal)),
  ]);
  return { skus: skus.map(({ code }) => code).sort(), stations: stations.map(({ code }) => code).sort() };
}

/** Until they are loaded, and where that fails, there is nothing to choose from. */
export function useCodes(): Codes {
  const codes = useResource(load);
  return codes.state === "ready" ? codes.value : NONE;
}
