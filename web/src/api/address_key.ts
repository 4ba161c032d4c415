// The key as it stands in an address. Nothing is stored here.

/** `#key=K` or `#key=K&/runs/ID` → the key and the address without it. */
export function splitKey(hash: string): { key: string | null; rest: string } {
  const match = /^#key=([^&]+)&?(.*)$/.exec(hash);
  if (match?.[1] === undefined) return { key: null, rest: hash };
  return { key: decode(match[1]).trim(), rest: match[2] ? `#${match[2]}` : "" };
}

function decode(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
