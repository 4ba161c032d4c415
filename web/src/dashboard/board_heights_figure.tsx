// The heights of a board's corners over the board, as the camera sees it: corner 0 at the top left.
import { type JSX } from "preact";
import { useMemo } from "preact/hooks";
import { boardHeights } from "../drawing/board_heights";
import { largestOf, scaleTicks } from "../drawing/heat_grid";
import { digitsOfStep } from "../drawing/scales";
import type { BoardShapeDetail } from "../generated/api";
import { fixed } from "../format/numbers";
import { language, words } from "../words/language";
import { HeatFigure, type HeatGround, type HeatScale } from "./heat_figure";

/** Below this the map writes tenths, µm. */
const TENTHS_BELOW = 10;

export function BoardHeightsFigure({ shape }: { shape: BoardShapeDetail }): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const heights = useMemo(() => boardHeights(cornersOf(shape)), [shape]);
  const scale = useMemo<HeatScale>(() => {
    const ticks = scaleTicks(largestOf(heights.grid));
    const digits = (ticks.at(-1) ?? 0) < TENTHS_BELOW ? 1 : 0;
    const tickDigits = digitsOfStep(ticks[1] ?? 1);
    return {
      ticks,
      unit: "µm",
      write: (value) => fixed(value, digits, spoken),
      writeTick: (value) => fixed(value, tickDigits, spoken),
    };
  }, [heights, spoken]);
  const ground = useMemo<HeatGround>(
    () => ({ image_size: [heights.size.width, heights.size.height] }),
    [heights],
  );
  const read = (row: number, column: number): string => {
    const corner = heights.corners[row]?.[column] ?? 0;
    const sd = 1000 * (shape.sd_mm[corner]?.[2] ?? 0);
    return say.shape_corner(corner, scale.write(heights.grid[row]?.[column] ?? 0), fixed(sd, 1));
  };
  return (
    <div class="board-heights">
      <h3 class="side-name">
        {say.shape_heights} <small class="muted">{say.shape_heights_note}</small>
      </h3>
      <HeatFigure
        label={say.heat_label(
          say.shape_heights,
          scale.unit,
          scale.write(0),
          scale.write(largestOf(heights.grid)),
        )}
        grid={heights.grid}
        scale={scale}
        ground={ground}
        gaps=""
        read={({ row, column }) => read(row, column)}
      />
    </div>
  );
}

function cornersOf({ corners_mm: corners, deviations_mm: moved }: BoardShapeDetail): {
  x: number;
  y: number;
  z: number;
}[] {
  return corners.map(([x, y], i) => ({ x, y, z: moved[i]?.[2] ?? 0 }));
}
