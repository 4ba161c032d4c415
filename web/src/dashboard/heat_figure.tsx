// One heat map over a camera's image or a board, with its scale and the value under the pointer.
import { type JSX } from "preact";
import { useCallback, useRef, useState } from "preact/hooks";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawHeatMap, drawScale } from "../drawing/heat_drawing";
import { cellAt, centreOf, largestOf, type Cell, type Grid, type Zone } from "../drawing/heat_grid";
import { fit, toImage } from "../drawing/viewport";
import { words } from "../words/language";

/** What the grid lies over: a camera's image with its zones, or without them something else. */
export interface HeatGround {
  image_size: [number, number];
  working_zone?: Zone;
  valid_region?: Zone;
}

export interface HeatScale {
  ticks: readonly number[];
  unit: string;
  /** How a value is written into the map, and one of the ticks at the scale. */
  write: (value: number) => string;
  writeTick: (value: number) => string;
}

interface Props {
  /** What it is called for those who do not see it. */
  label: string;
  grid: Grid;
  scale: HeatScale;
  ground: HeatGround;
  /** What a cell without a value means. */
  gaps: string;
  /** What is said of the cell under the pointer. */
  read: (cell: Cell) => string;
}

export function HeatFigure({ label, grid, scale, ground, gaps, read }: Props): JSX.Element {
  const say = words.value;
  const field = useRef<HTMLDivElement>(null);
  const [cell, setCell] = useState<Cell | null>(null);
  const [width, height] = ground.image_size;
  const end = scale.ticks.at(-1) ?? 1;
  const { working_zone: workingZone, valid_region: validRegion } = ground;
  const drawMap = useCallback<Draw>(
    (context, size, colours) =>
      drawHeatMap(
        context,
        size,
        {
          grid,
          imageSize: { width, height },
          end,
          write: scale.write,
          ...(workingZone && { workingZone }),
          ...(validRegion && { validRegion }),
        },
        colours,
      ),
    [grid, width, height, end, scale, workingZone, validRegion],
  );
  const drawBar = useCallback<Draw>(
    (context, size, colours) =>
      drawScale(
        context,
        size,
        { ticks: scale.ticks, write: scale.writeTick, isExceeded: largestOf(grid) > end },
        colours,
      ),
    [grid, scale, end],
  );
  const point = (event: MouseEvent): void => {
    const box = field.current?.getBoundingClientRect();
    if (box === undefined) return;
    const at = { x: event.clientX - box.left, y: event.clientY - box.top };
    setCell(cellAt(grid, { width, height }, toImage(fit({ width, height }, box), at)));
  };
  const place = (at: Cell): string => {
    if (workingZone === undefined) return "";
    const { x, y } = centreOf(grid, { width, height }, at);
    return `${say.heat_at(Math.round(x), Math.round(y))} `;
  };
  const hasGaps = grid.some((row) => row.includes(null));
  return (
    <figure class="field-figure heat">
      <figcaption>
        {workingZone !== undefined && <span class="key muted">{say.review_key_zone}</span>}
        {validRegion !== undefined && <span class="key muted">{say.review_key_valid}</span>}
        {hasGaps && <span class="key muted">{gaps}</span>}
        <span class="key heat-read">{cell !== null && `${place(cell)}${read(cell)}`}</span>
      </figcaption>
      <div
        ref={field}
        class="field"
        style={{ aspectRatio: `${width} / ${height}` }}
        onMouseMove={point}
        onMouseLeave={() => setCell(null)}
      >
        <Drawing draw={drawMap} label={label} />
      </div>
      <div class="heat-scale">
        <Drawing draw={drawBar} label={`0 … ${scale.writeTick(end)} ${scale.unit}`} />
        <span class="muted">{scale.unit}</span>
      </div>
    </figure>
  );
}
