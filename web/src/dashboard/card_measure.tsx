// A drawn card that is made as large as a real one that lies against the screen: by dragging its edge, or by keys.
import { type JSX } from "preact";
import { useRef, useState } from "preact/hooks";
import { fixed } from "../format/numbers";
import { words } from "../words/language";
import { CARD, LEAST_DENSITY, MOST_DENSITY } from "./screen_scale";

/** What CSS believes of screens: 96 pixels to an inch. */
const BELIEVED_DENSITY = 96 / 25.4;
const LEAST_PX = Math.ceil(LEAST_DENSITY * CARD.width);
const MOST_PX = Math.floor(MOST_DENSITY * CARD.width);
const MANY = 10;
const STEPS: Record<string, number> = {
  ArrowLeft: -1,
  ArrowDown: -1,
  ArrowRight: 1,
  ArrowUp: 1,
  PageDown: -MANY,
  PageUp: MANY,
};

interface Props {
  ratio: number;
  density: number | null;
  onKeep: (density: number) => void;
}

export function CardMeasure({ ratio, density, onKeep }: Props): JSX.Element {
  const say = words.value;
  // Device pixels.
  const [width, setWidth] = useState(Math.round((density ?? BELIEVED_DENSITY * ratio) * CARD.width));
  const choose = (pixels: number): void =>
    setWidth(Math.min(MOST_PX, Math.max(LEAST_PX, Math.round(pixels))));
  return (
    <div class="target-steps">
      <p>{say.screen_card_detail}</p>
      <Card width={width} ratio={ratio} onChoose={choose} />
      <div class="target-row">
        <button type="button" aria-label={say.screen_narrower} onClick={() => choose(width - 1)}>
          −
        </button>
        <output class="card-value">{say.screen_card_value(width, fixed(width / CARD.width, 3))}</output>
        <button type="button" aria-label={say.screen_wider} onClick={() => choose(width + 1)}>
          +
        </button>
        <button type="button" class="primary" onClick={() => onKeep(width / CARD.width)}>
          {say.screen_keep}
        </button>
      </div>
    </div>
  );
}

interface CardProps {
  width: number;
  ratio: number;
  onChoose: (pixels: number) => void;
}

function Card({ width, ratio, onChoose }: CardProps): JSX.Element {
  const say = words.value;
  const card = useRef<HTMLDivElement>(null);
  const cssWidth = width / ratio;
  const perMm = cssWidth / CARD.width;
  const drag = (event: PointerEvent): void => {
    if (card.current === null || event.buttons === 0) return;
    onChoose((event.clientX - card.current.getBoundingClientRect().left) * ratio);
  };
  const press = (event: KeyboardEvent): void => {
    const step = STEPS[event.key];
    if (step === undefined) return;
    event.preventDefault();
    onChoose(width + step * (event.shiftKey ? MANY : 1));
  };
  return (
    <div
      class="bank-card"
      ref={card}
      style={{
        width: `${cssWidth}px`,
        height: `${CARD.height * perMm}px`,
        borderRadius: `${CARD.radius * perMm}px`,
      }}
    >
      <span class="card-edge-label" aria-hidden="true">
        85.60 × 53.98 mm
      </span>
      <div
        class="card-edge"
        role="slider"
        tabIndex={0}
        aria-label={say.screen_card}
        aria-valuemin={LEAST_PX}
        aria-valuemax={MOST_PX}
        aria-valuenow={width}
        aria-valuetext={say.screen_card_value(width, fixed(width / CARD.width, 3))}
        onKeyDown={press}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={drag}
      />
    </div>
  );
}
