// The state of a board's shape, and of its drift, by word and sign.
import { type JSX } from "preact";
import type { DriftState, ShapeState } from "../generated/api";
import { words } from "../words/language";

const STATE_SIGNS: Record<ShapeState, string> = { draft: "◌", certified: "●", retired: "–" };
const DRIFT_SIGNS: Record<DriftState, string> = { steady: "●", near: "▲", over: "◆" };

export function ShapeTag({ state }: { state: ShapeState }): JSX.Element {
  const say = words.value;
  const name = { draft: say.shape_draft, certified: say.shape_certified, retired: say.shape_retired }[state];
  return (
    <span class={`publication shape-${state}`}>
      <span aria-hidden="true">{STATE_SIGNS[state]}</span> {name}
    </span>
  );
}

export function DriftTag({ state }: { state: DriftState }): JSX.Element {
  const say = words.value;
  const name = { steady: say.shape_drift_steady, near: say.shape_drift_near, over: say.shape_drift_over };
  return (
    <span class={`publication drift-${state}`}>
      <span aria-hidden="true">{DRIFT_SIGNS[state]}</span> {name[state]}
    </span>
  );
}
