// A small word where a run is not simply the first one of a vehicle in production.
import { type JSX } from "preact";
import type { Purpose } from "../generated/protocol";
import { words } from "../words/language";
import { purposeName } from "../words/measurements";

export function PurposeTag({ purpose }: { purpose: Purpose }): JSX.Element | null {
  if (purpose === "production") return null;
  return (
    <span class="purpose" data-purpose={purpose}>
      {purposeName(purpose, words.value)}
    </span>
  );
}
