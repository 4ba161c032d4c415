// Which runs a list shows. Names are those of the service's query, so that addresses, requests and links agree.

export const FILTER_NAMES = [
  "serial",
  "sku",
  "station",
  "without_station",
  "verdict",
  "failed",
  "since",
  "until",
  "counted",
  "first",
] as const;
export type FilterName = (typeof FILTER_NAMES)[number];
export type RunFilter = Readonly<Partial<Record<FilterName, string>>>;

export function filterFrom(query: URLSearchParams): RunFilter {
  const filter: Partial<Record<FilterName, string>> = {};
  for (const name of FILTER_NAMES) {
    const value = query.get(name)?.trim();
    if (value) filter[name] = value;
  }
  return filter;
}

/** The filter as a query without its question mark, always in the same order; empty where nothing is filtered. */
export function queryOf(filter: RunFilter): string {
  const query = new URLSearchParams();
  for (const name of FILTER_NAMES) {
    const value = filter[name];
    if (value) query.set(name, value);
  }
  return query.toString();
}

/** The filter with one condition more, or without it where `value` is empty. */
export function withCondition(filter: RunFilter, name: FilterName, value: string): RunFilter {
  return filterFrom(new URLSearchParams(queryOf({ ...filter, [name]: value })));
}
