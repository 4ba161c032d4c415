// A list that is short by nature, such as the stations of a plant, as a whole: part after part.

export interface ListPart<T> {
  items: T[];
  next_cursor: string | null;
}

/** A list that never ends must not keep a page loading. */
const MOST_PARTS = 20;

export async function allParts<T>(load: (cursor: string | null) => Promise<ListPart<T>>): Promise<T[]> {
  const items: T[] = [];
  let cursor: string | null = null;
  for (let part = 0; part < MOST_PARTS; part += 1) {
    const found: ListPart<T> = await load(cursor);
    items.push(...found.items);
    cursor = found.next_cursor;
    if (cursor === null) break;
  }
  return items;
}
