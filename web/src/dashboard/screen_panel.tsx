// Showing a target on the screen that the page is on: measure the screen once, then see what size comes out of it.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { fixed, plain, withUnit } from "../format/numbers";
import type { TargetPattern } from "../generated/api";
import { words } from "../words/language";
import { ScreenMeasure } from "./screen_measure";
import { scaledSpec, trueSize } from "./screen_scale";
import { ShownTarget } from "./shown_target";
import { squareName } from "./target_words";
import { TooLarge } from "./too_large";
import { useDensity, useScreen, type Screen } from "./use_screen";

export function ScreenPanel({ pattern }: { pattern: TargetPattern }): JSX.Element {
  const say = words.value;
  const screen = useScreen();
  const [density, keep] = useDensity(screen.name);
  const [isMeasuring, setMeasuring] = useState(false);
  const isKnown = density !== null && !isMeasuring;
  return (
    <section class="panel" aria-labelledby="screen-title">
      <div class="panel-head">
        <h2 id="screen-title">{say.screen_title}</h2>
        <span class="muted">{say.screen_ratio(plain(screen.ratio))}</span>
      </div>
      <div class="panel-body target-steps">
        <p>{say.screen_detail}</p>
        {!Number.isInteger(screen.ratio) && <p class="muted">{say.screen_ratio_broken}</p>}
        {isKnown ? (
          <>
            <div class="target-row">
              <span>{say.screen_known(fixed(density, 3))}</span>
              <button type="button" onClick={() => setMeasuring(true)}>
                {say.screen_again}
              </button>
            </div>
            <ToShow pattern={pattern} density={density} screen={screen} />
          </>
        ) : (
          <>
            {density === null && <strong>{say.screen_unknown}</strong>}
            <ScreenMeasure
              key={screen.name}
              ratio={screen.ratio}
              density={density}
              onKeep={(measured) => {
                keep(measured);
                setMeasuring(false);
              }}
            />
          </>
        )}
      </div>
    </section>
  );
}

/** Below a target that is shown stands what to declare; CSS pixels. */
const CAPTION_PX = 40;

interface Props {
  pattern: TargetPattern;
  density: number;
  screen: Screen;
}

function ToShow({ pattern, density, screen }: Props): JSX.Element {
  const say = words.value;
  const [isShown, setShown] = useState(false);
  const size = trueSize(1000 * (pattern.step_m ?? 0), density);
  const millimetres = (length: number): string => withUnit(fixed(1000 * length * size.factor, 2), "mm");
  const room = { width: screen.width, height: screen.height - CAPTION_PX * screen.ratio };
  const [width, height] = pattern.size_m.map(millimetres);
  return (
    <>
      <p>{size.isWhole ? say.show_whole(scaledSpec(pattern.spec, size.factor)) : say.show_exact}</p>
      <p>
        {say.show_check(
          `${squareName(pattern.spec, say)} ${millimetres(pattern.square_m)}`,
          width ?? "",
          height ?? "",
        )}
      </p>
      <TooLarge pattern={pattern} density={density * size.factor} screen={room} />
      <div class="target-row">
        <button type="button" class="primary" onClick={() => setShown(true)}>
          {say.show_start}
        </button>
      </div>
      {isShown && <ShownTarget pattern={pattern} density={density} onClose={() => setShown(false)} />}
    </>
  );
}
