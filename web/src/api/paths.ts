// Addresses of the REST interface.

export const ROOT = "/api/v1";

export interface RunsQuery {
  serial: string;
  cursor: string | null;
  limit: number;
}

export function runsPath({ serial, cursor, limit }: RunsQuery): string {
  const query = new URLSearchParams({ limit: String(limit) });
  if (serial !== "") query.set("serial", serial);
  if (cursor !== null) query.set("cursor", cursor);
  return `${ROOT}/runs?${query.toString()}`;
}
