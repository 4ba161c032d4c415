// The best practice of each badge, in this browser only: the service never hears of a badge, and nobody is ranked.

export interface Best {
  points: number;
  took_ms: number;
}

const STORED_AS = "dmscal.kiosk.practice";
/** The oldest ones go first. */
const MOST_KEPT = 500;

type Bests = Readonly<Record<string, Best>>;

/** Runs of other cameras ask for other poses, so that their points say nothing here. */
export function bestName(badge: string, sku: string, poses: number): string {
  return `${sku}/${poses}/${badge.trim()}`;
}

export function isBetter(score: Best, best: Best | null): boolean {
  if (best === null || score.points > best.points) return true;
  return score.points === best.points && score.took_ms < best.took_ms;
}

/** What is stored, without whatever else may lie there. */
export function readBests(stored: string | null): Bests {
  try {
    const found: unknown = JSON.parse(stored ?? "{}");
    if (typeof found !== "object" || found === null) return {};
    return Object.fromEntries(
      Object.entries(found).filter((entry): entry is [string, Best] => isBest(entry[1])),
    );
  } catch {
    return {};
  }
}

function isBest(value: unknown): value is Best {
  if (typeof value !== "object" || value === null) return false;
  const { points, took_ms } = value as Partial<Record<keyof Best, unknown>>;
  return typeof points === "number" && typeof took_ms === "number";
}

/** With one more, which is the newest. */
export function withBest(bests: Bests, name: string, best: Best): Bests {
  const others = Object.entries(bests).filter(([other]) => other !== name);
  return Object.fromEntries([...others, [name, best] as const].slice(-MOST_KEPT));
}

export function storedBest(name: string): Best | null {
  return readBests(localStorage.getItem(STORED_AS))[name] ?? null;
}

export function storeBest(name: string, best: Best): void {
  const bests = withBest(readBests(localStorage.getItem(STORED_AS)), name, best);
  localStorage.setItem(STORED_AS, JSON.stringify(bests));
}
