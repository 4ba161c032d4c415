// What is said of a target that does not fit on a screen: how much it needs, and which size of it fits.
import { type JSX } from "preact";
import { neededSize, shareThatFits } from "../drawing/target_drawing";
import type { Size } from "../drawing/viewport";
import { fixed, withUnit } from "../format/numbers";
import type { TargetPattern } from "../generated/api";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { addressOf } from "./route";
import { fittingFactor, scaledSpec } from "./screen_scale";

interface Props {
  pattern: TargetPattern;
  /** Device pixels per mm of the pattern as it is drawn. */
  density: number;
  /** Device pixels. */
  screen: Size;
}

export function TooLarge({ pattern, density, screen }: Props): JSX.Element | null {
  const say = words.value;
  const needed = neededSize(pattern, 1000 * density);
  if (needed.width <= screen.width && needed.height <= screen.height) return null;
  const share = shareThatFits(pattern, screen, 1000 * density);
  const millimetres = (pixels: number): string => withUnit(fixed(pixels / density, 0), "mm");
  return (
    <div class="notice notice-problem" role="alert">
      <strong>{say.show_too_large(millimetres(needed.width), millimetres(needed.height))}</strong>
      <Fitting spec={pattern.spec} factor={fittingFactor(1000 * pattern.square_m, share)} say={say} />
    </div>
  );
}

function Fitting({ spec, factor, say }: { spec: string; factor: number; say: Words }): JSX.Element {
  if (factor <= 0) return <p>{say.show_fits_none}</p>;
  const smaller = scaledSpec(spec, factor);
  return (
    <p>
      <a href={addressOf({ page: "target", spec: smaller })}>{say.show_fits(smaller)}</a>
    </p>
  );
}
