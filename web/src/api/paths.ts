// Addresses of the REST interface.

export const ROOT = "/api/v1";

/** Largest part of a list that the service gives at once. */
export const LARGEST_PART = 200;

export interface RunsQuery {
  /** Conditions as a query, without the question mark; empty for all runs. */
  filter: string;
  cursor: string | null;
  limit: number;
}

export function runsPath({ filter, cursor, limit }: RunsQuery): string {
  const query = new URLSearchParams(filter);
  query.set("limit", String(limit));
  if (cursor !== null) query.set("cursor", cursor);
  return `${ROOT}/runs?${query.toString()}`;
}

export function partPath(list: string, cursor: string | null): string {
  const query = new URLSearchParams({ limit: String(LARGEST_PART) });
  if (cursor !== null) query.set("cursor", cursor);
  return `${ROOT}${list}?${query.toString()}`;
}

export function yieldPath(sku: string, station: string): string {
  const query = new URLSearchParams();
  if (sku !== "") query.set("sku", sku);
  if (station !== "") query.set("station", station);
  return query.size === 0 ? `${ROOT}/statistics/yield` : `${ROOT}/statistics/yield?${query.toString()}`;
}
