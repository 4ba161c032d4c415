// The frame of a table of estimates: parameter, estimate, sd, unit. Not here: its rows.
import { type ComponentChildren, type JSX } from "preact";
import { words } from "../words/language";

interface Props {
  caption: string;
  unit: string;
  children: ComponentChildren;
}

export function EstimateTable({ caption, unit, children }: Props): JSX.Element {
  const say = words.value;
  return (
    <table class="intrinsics">
      <caption class="visually-hidden">{caption}</caption>
      <thead>
        <tr>
          <th scope="col">{say.col_parameter}</th>
          <th scope="col" class="number">
            {say.col_estimate}
          </th>
          <th scope="col" class="number">
            ± {say.col_sd}
          </th>
          <th scope="col">
            <span class="visually-hidden">{unit}</span>
          </th>
        </tr>
      </thead>
      <tbody>{children}</tbody>
    </table>
  );
}
