// What the measures of a target are called.
import type { Words } from "../words/en";

/** The measure that `square_m` is, by the kind of the target. */
export function squareName(spec: string, say: Words): string {
  if (spec.startsWith("circles:")) return say.target_step;
  return spec.startsWith("aprilgrid:") ? say.target_gap : say.target_square;
}
