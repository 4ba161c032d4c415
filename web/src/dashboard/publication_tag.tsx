// Draft, published or retired, by word and shape.
import { type JSX } from "preact";
import type { Publication } from "../generated/api";
import { words } from "../words/language";

const SIGNS: Record<Publication, string> = { draft: "◌", published: "●", retired: "–" };

export function PublicationTag({ state }: { state: Publication }): JSX.Element {
  const say = words.value;
  const name = { draft: say.state_draft, published: say.state_published, retired: say.state_retired }[state];
  return (
    <span class={`publication publication-${state}`}>
      <span aria-hidden="true">{SIGNS[state]}</span> {name}
    </span>
  );
}
