// Coverage and predicted mapping error over the image: of one pose set, or of two on one common scale.
import { type ComponentChildren, type JSX } from "preact";
import { useMemo, useState } from "preact/hooks";
import { largestOf, scaleTicks, type Grid } from "../drawing/heat_grid";
import type { PoseSetReview } from "../generated/api";
import { fixed, significant } from "../format/numbers";
import { language, words } from "../words/language";
import { HeatFigure, type HeatScale } from "./heat_figure";
import { errorScale, labelOf, largestWithin, UnitChoice, type ErrorUnit } from "./heat_scale";

interface Props {
  reviews: readonly PoseSetReview[];
  /** What stands over each map where there are several. */
  names: readonly string[];
}

export function CoveragePanel({ reviews, names }: Props): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const scale = useMemo<HeatScale>(() => {
    const most = Math.max(...reviews.map(({ maps }) => largestOf(maps.boards)));
    const write = (value: number): string => fixed(value, 0, spoken);
    return { ticks: scaleTicks(most), unit: say.heat_boards, write, writeTick: write };
  }, [reviews, say, spoken]);
  return (
    <HeatPanel title={say.heat_coverage} note={say.heat_coverage_note} names={names}>
      {reviews.map((review) => (
        <HeatFigure
          key={review.id}
          label={labelOf(say.heat_coverage, review, review.maps.boards, scale)}
          grid={review.maps.boards}
          scale={scale}
          ground={review}
          gaps={say.heat_no_lens}
          read={({ row, column }) =>
            `${review.maps.boards[row]?.[column] ?? 0} ${say.heat_boards}, ${say.heat_corners(review.maps.corners[row]?.[column] ?? 0)}`
          }
        />
      ))}
    </HeatPanel>
  );
}

export function ErrorPanel({ reviews, names }: Props): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const [unit, setUnit] = useState<ErrorUnit>("px");
  const scale = useMemo<HeatScale>(() => {
    const most = Math.max(...reviews.map((review) => largestWithin(gridOf(review, unit), review)));
    return errorScale(most, unit, spoken);
  }, [reviews, unit, spoken]);
  return (
    <HeatPanel title={say.heat_error} names={names} choice={<UnitChoice unit={unit} onChoose={setUnit} />}>
      {reviews.map((review) => {
        const grid = gridOf(review, unit);
        return (
          <HeatFigure
            key={review.id}
            label={labelOf(say.heat_error, review, grid, scale)}
            grid={grid}
            scale={scale}
            ground={review}
            gaps={say.heat_no_lens}
            read={({ row, column }) => {
              const { sd_px, sd_mdeg } = review.maps;
              return `${significant(sd_px[row]?.[column])} px, ${significant(sd_mdeg[row]?.[column])} mdeg`;
            }}
          />
        );
      })}
    </HeatPanel>
  );
}

interface PanelProps {
  title: string;
  note?: string;
  choice?: JSX.Element;
  names: readonly string[];
  children: ComponentChildren[];
}

function HeatPanel({ title, note, choice, names, children }: PanelProps): JSX.Element {
  const say = words.value;
  const isShared = children.length > 1;
  return (
    <section class={`panel ${isShared ? "wide" : ""}`} aria-label={title}>
      <div class="panel-head">
        <h2>{title}</h2>
        {note !== undefined && <span class="muted">{note}</span>}
        {isShared && <span class="muted">{say.heat_common}</span>}
        {choice}
      </div>
      <div class={isShared ? "columns columns-half" : ""}>
        {children.map((child, i) => (
          <div key={i}>
            {isShared && <h3 class="side-name">{names[i]}</h3>}
            {child}
          </div>
        ))}
      </div>
    </section>
  );
}

function gridOf({ maps }: PoseSetReview, unit: ErrorUnit): Grid {
  return unit === "px" ? maps.sd_px : maps.sd_mdeg;
}
