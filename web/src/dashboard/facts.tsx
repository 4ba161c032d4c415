// Names and values, one under the other.
import { type JSX } from "preact";

export interface Fact {
  name: string;
  value: string;
  note?: string;
  /** The whole of a value that is shown shortened. */
  title?: string;
}

export function Facts({ facts }: { facts: readonly Fact[] }): JSX.Element {
  return (
    <dl class="facts">
      {facts.map((fact) => (
        <div key={fact.name}>
          <dt>
            {fact.name}
            {fact.note !== undefined && <small>{fact.note}</small>}
          </dt>
          <dd title={fact.title}>{fact.value}</dd>
        </div>
      ))}
    </dl>
  );
}
