// RMS and largest residual per view as bars in a table, so that they are read by eye and by screen reader alike.
import { type JSX } from "preact";
import type { Capture, ViewResult } from "../generated/api";
import { median } from "../drawing/scales";
import { fixed } from "../format/numbers";
import { words } from "../words/language";

interface Props {
  views: readonly ViewResult[];
  captures: readonly Capture[];
  chosenId: string;
  onChoose: (id: string) => void;
}

export function ViewsTable({ views, captures, chosenId, onChoose }: Props): JSX.Element {
  const say = words.value;
  const middle = median(views.map((view) => view.rms_px));
  const largest = Math.max(...views.map((view) => view.max_px), Number.EPSILON);
  const numbers = new Map(captures.map((capture) => [capture.id, capture.number]));
  return (
    <figure class="views">
      <figcaption>
        <h3>{say.views_title}</h3>
        <span class="key muted">{say.views_median(fixed(middle, 3))}</span>
      </figcaption>
      <table>
        <caption class="visually-hidden">{say.views_caption}</caption>
        <thead>
          <tr>
            <th scope="col">{say.col_view}</th>
            <th scope="col" class="number">
              {say.col_rms} px
            </th>
            <th scope="col" aria-hidden="true" />
            <th scope="col" class="number">
              {say.col_max} px
            </th>
          </tr>
        </thead>
        <tbody>
          {views.map((view) => (
            <tr key={view.capture_id} class={view.capture_id === chosenId ? "chosen" : ""}>
              <th scope="row">
                <button
                  type="button"
                  class="row-link"
                  aria-pressed={view.capture_id === chosenId}
                  aria-label={say.capture_number(numbers.get(view.capture_id) ?? 0)}
                  onClick={() => onChoose(view.capture_id)}
                >
                  {numbers.get(view.capture_id) ?? view.name}
                </button>
              </th>
              <td class="number">{fixed(view.rms_px, 3)}</td>
              <td class="bar-cell" aria-hidden="true">
                <ViewBar rms={view.rms_px / largest} max={view.max_px / largest} median={middle / largest} />
              </td>
              <td class="number muted">{fixed(view.max_px, 3)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </figure>
  );
}

function ViewBar({ rms, max, median: middle }: { rms: number; max: number; median: number }): JSX.Element {
  return (
    <svg class="view-bar" viewBox="0 0 100 12" preserveAspectRatio="none">
      <rect class="view-bar-max" x="0" y="5" width={100 * max} height="2" />
      <rect class="view-bar-rms" x="0" y="2" width={100 * rms} height="8" />
      <rect class="view-bar-median" x={100 * middle - 0.4} y="0" width="0.8" height="12" />
    </svg>
  );
}
