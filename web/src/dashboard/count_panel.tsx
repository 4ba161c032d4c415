// The predicted error against the number of poses, of one set or of two; shown only where a planner told it.
import { type JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { countOptions, type CountChart } from "../drawing/count_chart";
import { columnsOf, pointAt, QUANTITIES, type Curve, type Quantity } from "../drawing/count_curve";
import { coloursOf } from "../drawing/drawing";
import type { PoseSet } from "../generated/api";
import { plain, significant, withUnit } from "../format/numbers";
import { dark } from "../look/theme";
import { language, words } from "../words/language";
import type { Words } from "../words/en";
import { mountPlot } from "./mounted_plot";

const HEIGHT_PX = 290;

export interface NamedSet {
  name: string;
  set: PoseSet;
}

export function CountPanel({ sets }: { sets: readonly NamedSet[] }): JSX.Element | null {
  const say = words.value;
  const curves = useMemo(() => sets.flatMap(curveOf), [sets]);
  const [count, setCount] = useState<number | null>(null);
  const required = sets
    .map(({ set }) => set.prediction?.required_mapping_px)
    .find((value) => typeof value === "number");
  if (curves.length === 0) return null;
  const counts = curves.flatMap(({ points }) => points.map(({ poses }) => poses));
  return (
    <section class="panel" aria-labelledby="count-title">
      <div class="panel-head">
        <h2 id="count-title">{say.curve_title}</h2>
        <span class="muted key">{count === null ? say.curve_note : readOut(curves, count, say)}</span>
      </div>
      <Chart
        curves={curves}
        required={required ?? null}
        onPoint={setCount}
        label={say.curve_label(Math.min(...counts), Math.max(...counts))}
      />
      <details class="panel-body count-numbers">
        <summary>{say.curve_numbers}</summary>
        <Numbers curves={curves} />
      </details>
    </section>
  );
}

function curveOf({ name, set: { prediction, poses } }: NamedSet): Curve[] {
  const points = prediction?.curve ?? [];
  if (points.length === 0) return [];
  return [{ name, points, own: poses.length, smallest: prediction?.smallest_count ?? null }];
}

interface ChartProps {
  curves: readonly Curve[];
  required: number | null;
  label: string;
  onPoint: (count: number | null) => void;
}

function Chart({ curves, required, label, onPoint }: ChartProps): JSX.Element {
  const place = useRef<HTMLDivElement>(null);
  const say = words.value;
  const spoken = language.value;
  const isDark = dark.value;

  useEffect(() => {
    const { current } = place;
    if (current === null) return undefined;
    const chart: CountChart = {
      curves,
      required,
      write: (value) => plain(value, spoken),
      words: {
        quantity: quantityNames(say),
        required: say.curve_required,
        own: ({ name, own }) => (name === "" ? say.curve_own(own) : say.curve_own_of(name, own)),
        smallest: ({ name, smallest }) =>
          name === "" ? say.curve_smallest(smallest ?? 0) : say.curve_smallest_of(name, smallest ?? 0),
        axis: say.curve_axis,
      },
      onPoint,
    };
    const colours = coloursOf(current);
    return mountPlot(current, HEIGHT_PX, (size) => countOptions(chart, size, colours), columnsOf(curves));
  }, [curves, required, onPoint, say, spoken, isDark]);

  return <div ref={place} class="count-chart" role="img" aria-label={label} />;
}

function quantityNames(say: Words): Record<Quantity, string> {
  return { mapping_mean_px: say.curve_mean, mapping_worst_px: say.curve_worst, norm_px: say.curve_norm };
}

function readOut(curves: readonly Curve[], count: number, say: Words): string {
  const names = quantityNames(say);
  const parts = curves.flatMap((curve) => {
    const point = pointAt(curve, count);
    if (point === undefined) return [];
    const values = QUANTITIES.map((name) => `${names[name]} ${withUnit(significant(point[name]), "px")}`);
    return [curves.length > 1 ? `${curve.name} ${values.join(", ")}` : values.join(", ")];
  });
  return `${say.curve_at(count)} ${parts.join(" · ")}`;
}

function Numbers({ curves }: { curves: readonly Curve[] }): JSX.Element {
  const say = words.value;
  const names = quantityNames(say);
  const [counts] = columnsOf(curves);
  return (
    <div class="wide-table">
      <table>
        <thead>
          <tr>
            <th scope="col">N</th>
            {curves.flatMap(({ name }) =>
              QUANTITIES.map((quantity) => (
                <th key={`${name} ${quantity}`} scope="col" class="number">
                  {curves.length > 1 ? `${name} ${names[quantity]}` : names[quantity]}
                </th>
              )),
            )}
          </tr>
        </thead>
        <tbody>
          {counts.map((count) => (
            <tr key={count}>
              <th scope="row">{count}</th>
              {curves.flatMap((curve) =>
                QUANTITIES.map((quantity) => (
                  <td key={`${curve.name} ${quantity}`} class="number">
                    {withUnit(significant(pointAt(curve, count)?.[quantity]), "px")}
                  </td>
                )),
              )}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
