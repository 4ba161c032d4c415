// The error of a result over the image: what its covariance promises, and what the corners left over.
import { type JSX } from "preact";
import { useCallback, useMemo, useState } from "preact/hooks";
import { getResultMaps } from "../api/client";
import { useResource } from "../api/use_resource";
import { largestOf } from "../drawing/heat_grid";
import type { ResultMaps } from "../generated/api";
import { significant } from "../format/numbers";
import { Loading, ProblemNotice } from "../shell/notices";
import { language, words } from "../words/language";
import { HeatFigure } from "./heat_figure";
import { errorScale, labelOf, largestWithin, UnitChoice, type ErrorUnit } from "./heat_scale";

export function ErrorMapsPanel({ runId }: { runId: string }): JSX.Element {
  const say = words.value;
  const [unit, setUnit] = useState<ErrorUnit>("px");
  const found = useResource(useCallback((signal: AbortSignal) => getResultMaps(runId, signal), [runId]));
  return (
    <section class="panel" aria-labelledby="maps-title">
      <div class="panel-head">
        <h2 id="maps-title">{say.maps_title}</h2>
        <UnitChoice unit={unit} onChoose={setUnit} />
      </div>
      {found.state === "loading" && <Loading />}
      {found.state === "failed" && <ProblemNotice problem={found.problem} />}
      {found.state === "ready" && (
        <div class="columns columns-half">
          <Expected maps={found.value} unit={unit} />
          <Measured maps={found.value} />
        </div>
      )}
    </section>
  );
}

function Expected({ maps, unit }: { maps: ResultMaps; unit: ErrorUnit }): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const grid = unit === "px" ? maps.sd_px : maps.sd_mdeg;
  const scale = useMemo(
    () => errorScale(largestWithin(grid, maps), unit, spoken),
    [grid, maps, unit, spoken],
  );
  return (
    <div>
      <h3 class="side-name">
        {say.maps_expected} <small class="muted">{say.maps_expected_note}</small>
      </h3>
      <HeatFigure
        label={labelOf(say.maps_expected, maps, grid, scale)}
        grid={grid}
        scale={scale}
        ground={maps}
        gaps={say.heat_no_lens}
        read={({ row, column }) =>
          `${significant(maps.sd_px[row]?.[column])} px, ${significant(maps.sd_mdeg[row]?.[column])} mdeg`
        }
      />
    </div>
  );
}

function Measured({ maps }: { maps: ResultMaps }): JSX.Element {
  const say = words.value;
  const spoken = language.value;
  const grid = maps.residual_rms_px;
  const scale = useMemo(() => errorScale(largestOf(grid), "px", spoken), [grid, spoken]);
  return (
    <div>
      <h3 class="side-name">
        {say.maps_measured} <small class="muted">{say.maps_measured_note}</small>
      </h3>
      <HeatFigure
        label={labelOf(say.maps_measured, maps, grid, scale)}
        grid={grid}
        scale={scale}
        ground={maps}
        gaps={say.maps_no_corner}
        read={({ row, column }) =>
          `${significant(grid[row]?.[column])} px, ${say.heat_corners(maps.corners[row]?.[column] ?? 0)}`
        }
      />
    </div>
  );
}
