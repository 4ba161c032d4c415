// Walking a list by cursors: the service gives only the next one, so the way back is remembered here.

/** Cursors of the pages walked so far; the last one is the page on show, null is the first page. */
export type Walk = readonly (string | null)[];

export const FIRST_PAGE: Walk = [null];

export function shownCursor(walk: Walk): string | null {
  return walk.at(-1) ?? null;
}

export function onward(walk: Walk, nextCursor: string | null): Walk {
  return nextCursor === null ? walk : [...walk, nextCursor];
}

export function back(walk: Walk): Walk {
  return walk.length > 1 ? walk.slice(0, -1) : walk;
}

export function isFirst(walk: Walk): boolean {
  return walk.length <= 1;
}
