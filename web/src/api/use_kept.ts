// What was loaded last stays on show while the same page loads it again after a change.
import { useRef } from "preact/hooks";
import type { Resource } from "./use_resource";

export function useKept<T>(found: Resource<T>): Resource<T> {
  const kept = useRef<Resource<T>>(found);
  if (found.state !== "loading") kept.current = found;
  return kept.current;
}
