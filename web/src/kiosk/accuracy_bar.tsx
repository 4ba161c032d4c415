// How near the captures so far bring the camera to the accuracy that its SKU asks for: a bar, and no figures.
import { type JSX } from "preact";
import type { Estimate } from "../generated/protocol";
import type { Words } from "../words/en";

export function AccuracyBar({ estimate, say }: { estimate: Estimate | null; say: Words }): JSX.Element {
  const percent = Math.floor(100 * (estimate?.reached ?? 0));
  const isReached = percent >= 100;
  const said = isReached
    ? `✓ ${say.guide_accuracy_reached}`
    : estimate === null
      ? say.guide_accuracy_none
      : say.guide_accuracy_growing;
  return (
    <div class="match accuracy">
      <span id="accuracy-name">{say.guide_accuracy}</span>
      <span class="accuracy-said">{said}</span>
      <div
        class={`match-bar accuracy-bar ${isReached ? "match-good" : ""}`}
        role="meter"
        aria-labelledby="accuracy-name"
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={percent}
        aria-valuetext={said}
      >
        <div class="match-fill" style={{ width: `${percent}%` }} />
      </div>
    </div>
  );
}
