// Measuring a screen's pixels: a drawn card is made as large as a real one, or a drawn bar is measured with a ruler.
import { type JSX } from "preact";
import { useId, useRef, useState } from "preact/hooks";
import { words } from "../words/language";
import { CardMeasure } from "./card_measure";
import { isDensity } from "./screen_scale";

interface Props {
  /** Device pixels per CSS pixel. */
  ratio: number;
  /** Device pixels per mm, as measured before. */
  density: number | null;
  onKeep: (density: number) => void;
}

export function ScreenMeasure({ ratio, density, onKeep }: Props): JSX.Element {
  const say = words.value;
  const [method, setMethod] = useState<"card" | "ruler">("card");
  return (
    <>
      <div class="target-row">
        <div class="segments" role="group" aria-label={say.screen_title}>
          <button type="button" aria-pressed={method === "card"} onClick={() => setMethod("card")}>
            {say.screen_by_card}
          </button>
          <button type="button" aria-pressed={method === "ruler"} onClick={() => setMethod("ruler")}>
            {say.screen_by_ruler}
          </button>
        </div>
      </div>
      {method === "card" ? (
        <CardMeasure ratio={ratio} density={density} onKeep={onKeep} />
      ) : (
        <RulerMeasure ratio={ratio} onKeep={onKeep} />
      )}
      <p class="muted">{say.screen_kept_note}</p>
    </>
  );
}

function RulerMeasure({ ratio, onKeep }: Omit<Props, "density">): JSX.Element {
  const say = words.value;
  const field = useId();
  const bar = useRef<HTMLDivElement>(null);
  const [isWrong, setWrong] = useState(false);
  const [typed, setTyped] = useState("");
  const keep = (event: SubmitEvent): void => {
    event.preventDefault();
    const pixels = (bar.current?.getBoundingClientRect().width ?? 0) * ratio;
    const density = pixels / Number(typed.replace(",", "."));
    setWrong(!isDensity(density));
    if (isDensity(density)) onKeep(density);
  };
  return (
    <form class="target-steps" onSubmit={keep}>
      <p>{say.screen_ruler_detail}</p>
      <div class="measured-bar" ref={bar} />
      <div class="target-row">
        <label for={field}>{say.screen_ruler}</label>
        <input
          id={field}
          type="search"
          inputMode="decimal"
          required
          size={8}
          autocomplete="off"
          value={typed}
          aria-invalid={isWrong}
          onInput={(event) => setTyped(event.currentTarget.value)}
        />
        <button type="submit" class="primary">
          {say.screen_keep}
        </button>
      </div>
      {isWrong && (
        <p class="notice notice-problem" role="alert">
          {say.screen_ruler_wrong}
        </p>
      )}
    </form>
  );
}
