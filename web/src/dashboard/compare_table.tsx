// The figures of two pose sets with their ratio; better and worse by word and sign.
import { type JSX } from "preact";
import { fixed, percent, significant, withUnit } from "../format/numbers";
import { words } from "../words/language";
import type { Words } from "../words/en";
import type { Side } from "./review_comparison";
import { compareFigures, judged, type ComparedFigure, type FigureName } from "./review_sums";

export function CompareTable({ a, b }: { a: Side; b: Side }): JSX.Element {
  const say = words.value;
  return (
    <section class="panel" aria-labelledby="compare-title">
      <div class="panel-head">
        <h2 id="compare-title">{say.compare_figures}</h2>
      </div>
      <div class="wide-table">
        <table class="compare">
          <thead>
            <tr>
              <th scope="col">
                <span class="visually-hidden">{say.compare_figures}</span>
              </th>
              <th scope="col" class="number">
                A
              </th>
              <th scope="col" class="number">
                B
              </th>
              <th scope="col" class="number">
                {say.compare_ratio}
              </th>
              <th scope="col">
                <span class="visually-hidden">{say.compare_ratio}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {compareFigures(a, b).map((figure) => (
              <tr key={figure.name}>
                <th scope="row">{nameOf(figure.name, say)}</th>
                <td class="number">{written(figure.name, figure.a)}</td>
                <td class="number">{written(figure.name, figure.b)}</td>
                <td class="number estimate">{ratioOf(figure)}</td>
                <td>
                  <Judgement figure={figure} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function Judgement({ figure }: { figure: ComparedFigure }): JSX.Element | null {
  const say = words.value;
  const found = judged(figure);
  if (found === null) return null;
  const [sign, word] = {
    better: ["▲", say.compare_better],
    worse: ["▼", say.compare_worse],
    same: ["=", say.compare_same],
  }[found];
  return (
    <span class={`judged judged-${found}`}>
      <span aria-hidden="true">{sign}</span> {word}
    </span>
  );
}

function ratioOf({ a, b }: ComparedFigure): string {
  return a === null || b === null || a === 0 ? "–" : `× ${fixed(b / a, 2)}`;
}

function nameOf(name: FigureName, say: Words): string | JSX.Element {
  switch (name) {
    case "poses":
      return say.review_poses;
    case "zone_mean":
      return say.review_zone_error;
    case "zone_worst":
      return say.compare_zone_worst;
    case "valid_worst":
      return say.compare_valid_worst;
    case "norm":
      return say.review_norm;
    case "covered":
      return say.review_covered;
    case "pitch":
      return say.col_pitch;
    case "yaw":
      return say.col_yaw;
    case "nearest":
      return say.compare_nearest;
    case "farthest":
      return say.compare_farthest;
    case "square":
      return say.col_square;
    default:
      return (
        <>
          ± <var>{name.slice("sd_".length)}</var>
        </>
      );
  }
}

const IN_PIXELS = new Set([
  "zone_mean",
  "zone_worst",
  "valid_worst",
  "norm",
  "square",
  "sd_fx",
  "sd_fy",
  "sd_cx",
  "sd_cy",
]);

function written(name: FigureName, value: number | null): string {
  if (value === null) return "–";
  if (name === "poses") return String(value);
  if (name === "covered") return percent(value);
  if (name === "pitch" || name === "yaw") return `${fixed(value, 0)}°`;
  if (name === "nearest" || name === "farthest") return `${fixed(value, 2)} m`;
  return withUnit(significant(value), IN_PIXELS.has(name) ? "px" : "");
}
