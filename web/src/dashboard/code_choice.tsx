// A choice of one value, such as a SKU or a station, or all of them.
import { type JSX } from "preact";
import { useId } from "preact/hooks";
import { words } from "../words/language";

interface Props {
  label: string;
  /** The code on show; empty for all. */
  value: string;
  codes: readonly string[];
  /** How a code is written; as it is where not given. */
  nameOf?: (code: string) => string;
  onChoose: (code: string) => void;
}

export function CodeChoice({ label, value, codes, nameOf, onChoose }: Props): JSX.Element {
  const id = useId();
  // A code out of an address may be unknown, or the codes not yet loaded.
  const shown = value === "" || codes.includes(value) ? codes : [value, ...codes];
  return (
    <span class="choice">
      <label for={id}>{label}</label>
      <select id={id} value={value} onChange={(event) => onChoose(event.currentTarget.value)}>
        <option value="">{words.value.choice_all}</option>
        {shown.map((code) => (
          <option key={code} value={code}>
            {nameOf?.(code) ?? code}
          </option>
        ))}
      </select>
    </span>
  );
}
