// The scale of a map of errors, in px or as an angle, and what the map is called for those who do not see it.
import { type JSX } from "preact";
import { rangeWithin, scaleTicks, type Grid } from "../drawing/heat_grid";
import { digitsOfStep } from "../drawing/scales";
import { fixed } from "../format/numbers";
import { words } from "../words/language";
import type { HeatGround, HeatScale } from "./heat_figure";

/** The ground of an error is an image, with the zones that count. */
type ImageGround = Required<HeatGround>;

export const ERROR_UNITS = ["px", "mdeg"] as const;
export type ErrorUnit = (typeof ERROR_UNITS)[number];

export function errorScale(largest: number, unit: ErrorUnit, spoken: string): HeatScale {
  const ticks = scaleTicks(largest);
  const digits = digitsOfStep(ticks[1] ?? 1);
  return {
    ticks,
    unit,
    write: (value) => shortly(value, spoken),
    writeTick: (value) => fixed(value, digits, spoken),
  };
}

/** Short enough for a map: 0.043, 1.6, 12. */
function shortly(value: number, spoken: string): string {
  if (value === 0) return "0";
  return fixed(value, value < 0.1 ? 3 : value < 1 ? 2 : value < 10 ? 1 : 0, spoken);
}

/** The largest value that counts for a scale: beyond the valid region an error may grow without end. */
export function largestWithin(grid: Grid, ground: ImageGround): number {
  return rangeWithin(grid, sizeOf(ground), ground.valid_region).largest;
}

export function labelOf(name: string, ground: ImageGround, grid: Grid, scale: HeatScale): string {
  const { least, largest } = rangeWithin(grid, sizeOf(ground), ground.valid_region);
  return words.value.heat_label(name, scale.unit, scale.write(least), scale.write(largest));
}

function sizeOf({ image_size: [width, height] }: HeatGround): { width: number; height: number } {
  return { width, height };
}

export function UnitChoice({
  unit,
  onChoose,
}: {
  unit: ErrorUnit;
  onChoose: (unit: ErrorUnit) => void;
}): JSX.Element {
  return (
    <span class="segments" role="group" aria-label={words.value.heat_unit}>
      {ERROR_UNITS.map((name) => (
        <button key={name} type="button" aria-pressed={name === unit} onClick={() => onChoose(name)}>
          {name}
        </button>
      ))}
    </span>
  );
}
