// How far the mappings of two runs are apart over the image: figures by zone, a heat map, and the vectors.
import { type JSX } from "preact";
import { useCallback, useMemo, useState } from "preact/hooks";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawOffsets } from "../drawing/offset_drawing";
import { offsetsOf } from "../drawing/offsets";
import { gainFor } from "../drawing/residuals";
import type { ComparedZone, RunComparison } from "../generated/api";
import { fixed, significant, withUnit } from "../format/numbers";
import { language, words } from "../words/language";
import type { Words } from "../words/en";
import { HeatFigure } from "./heat_figure";
import { errorScale, labelOf, largestWithin, UnitChoice, type ErrorUnit } from "./heat_scale";
import { WideTable } from "./wide_table";

/** The rms offset of the zone is drawn about this long, as a share of the image's width. */
const ARROW_SHARE = 0.025;

export function ComparedMappings({ comparison }: { comparison: RunComparison }): JSX.Element {
  const say = words.value;
  const [unit, setUnit] = useState<ErrorUnit>("px");
  return (
    <section class="panel" aria-labelledby="mapping-title">
      <div class="panel-head">
        <h2 id="mapping-title">{say.pair_mapping}</h2>
        <span class="muted">{say.pair_mapping_note}</span>
        <UnitChoice unit={unit} onChoose={setUnit} />
      </div>
      <WideTable label={say.pair_mapping}>
        <table class="compare">
          <thead>
            <tr>
              <th scope="col">
                <span class="visually-hidden">{say.pair_mapping}</span>
              </th>
              {[say.pair_mean, say.pair_worst, say.pair_expected].map((name) => (
                <th key={name} scope="col" class="number">
                  {name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            <ZoneRow name={say.pair_working_zone} zone={comparison.working_zone} say={say} />
            <ZoneRow name={say.pair_valid_region} zone={comparison.valid_region} say={say} />
          </tbody>
        </table>
      </WideTable>
      <div class="columns columns-half">
        <Distances comparison={comparison} unit={unit} />
        <Vectors comparison={comparison} />
      </div>
    </section>
  );
}

function ZoneRow({ name, zone, say }: { name: string; zone: ComparedZone; say: Words }): JSX.Element {
  const both = (px: number | null, mdeg: number | null): string =>
    `${withUnit(significant(px), "px")} · ${withUnit(significant(mdeg), "mdeg")}`;
  const times =
    zone.mean_px === null || zone.expected_px === null || zone.expected_px === 0
      ? ""
      : say.pair_times(fixed(zone.mean_px / zone.expected_px, 1));
  return (
    <tr>
      <th scope="row">{name}</th>
      <td class="number estimate">{both(zone.mean_px, zone.mean_mdeg)}</td>
      <td class="number">{both(zone.worst_px, zone.worst_mdeg)}</td>
      <td class="number">
        {withUnit(significant(zone.expected_px), "px")} <small class="muted">{times}</small>
      </td>
    </tr>
  );
}

function Distances({ comparison, unit }: { comparison: RunComparison; unit: ErrorUnit }): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const { maps } = comparison;
  const grid = unit === "px" ? maps.distance_px : maps.distance_mdeg;
  const scale = useMemo(
    () => errorScale(largestWithin(grid, comparison), unit, spoken),
    [grid, comparison, unit, spoken],
  );
  return (
    <HeatFigure
      label={labelOf(say.pair_mapping, comparison, grid, scale)}
      grid={grid}
      scale={scale}
      ground={comparison}
      gaps={say.heat_no_lens}
      read={({ row, column }) =>
        `${significant(maps.distance_px[row]?.[column])} px, ${significant(maps.distance_mdeg[row]?.[column])} mdeg`
      }
    />
  );
}

function Vectors({ comparison }: { comparison: RunComparison }): JSX.Element {
  const say = words.value;
  const { maps, image_size, working_zone, valid_region } = comparison;
  const [width, height] = image_size;
  const offsets = useMemo(
    () => offsetsOf(maps.offset_u_px, maps.offset_v_px, { width, height }, valid_region),
    [maps, width, height, valid_region],
  );
  const gain = gainFor(working_zone.mean_px ?? 1, ARROW_SHARE * width);
  const draw = useCallback<Draw>(
    (context, size, colours) =>
      drawOffsets(
        context,
        size,
        { offsets, imageSize: { width, height }, gain, workingZone: working_zone },
        colours,
      ),
    [offsets, width, height, gain, working_zone],
  );
  return (
    <figure class="field-figure">
      <figcaption>
        <span class="key muted">{say.pair_vectors}</span>
        <span class="key muted">{say.field_gain(gain)}</span>
      </figcaption>
      <div class="field" style={{ aspectRatio: `${width} / ${height}` }}>
        <Drawing draw={draw} label={say.pair_vectors_label(offsets.length)} />
      </div>
    </figure>
  );
}
