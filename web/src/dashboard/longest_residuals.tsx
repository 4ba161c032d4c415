// The longest residuals as a list: the strange points of the drawings, for those who use no pointer.
import { type JSX } from "preact";
import { fixed, withUnit } from "../format/numbers";
import { words } from "../words/language";
import { longest, type RunCorner, type Spot } from "./run_residuals";

const SHOWN = 6;

interface Props {
  all: readonly RunCorner[];
  numbers: ReadonlyMap<string, number>;
  sigma: number;
  spot: Spot | null;
  onChoose: (spot: Spot) => void;
}

export function LongestResiduals({ all, numbers, sigma, spot, onChoose }: Props): JSX.Element {
  const say = words.value;
  return (
    <div class="longest">
      <h3 id="longest-title">{say.longest_title}</h3>
      <ol aria-labelledby="longest-title">
        {longest(all, SHOWN).map((found) => (
          <li key={`${found.captureId} ${found.corner}`}>
            <button
              type="button"
              aria-pressed={spot?.captureId === found.captureId && spot.corner === found.corner}
              onClick={() => onChoose(found)}
            >
              {say.longest_at(numbers.get(found.captureId) ?? 0, found.corner)}
            </button>
            <span>{withUnit(fixed(found.length, 3), "px")}</span>
            <span class="muted">{sigma > 0 ? `${fixed(found.length / sigma, 1)} σ` : ""}</span>
          </li>
        ))}
      </ol>
    </div>
  );
}
