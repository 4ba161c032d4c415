// Asks which station this is, when the address does not say it.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { words } from "../words/language";
import { LanguageAndLight } from "./switches";

export function StationForm({ onChosen }: { onChosen: (station: string) => void }): JSX.Element {
  const say = words.value;
  const [typed, setTyped] = useState("");
  const choose = (event: SubmitEvent): void => {
    event.preventDefault();
    if (typed.trim() !== "") onChosen(typed.trim());
  };
  return (
    <main class="start">
      <form class="start-card" onSubmit={choose}>
        <h1>{say.kiosk_no_station}</h1>
        <label class="start-detail" for="station">
          {say.kiosk_no_station_detail}
        </label>
        <div class="serial-row">
          <input
            id="station"
            class="serial-field"
            autocomplete="off"
            spellcheck={false}
            aria-label={say.kiosk_station_code}
            value={typed}
            ref={(input) => input?.focus()}
            onInput={(event) => setTyped(event.currentTarget.value)}
          />
          <button type="submit" class="act act-primary">
            {say.kiosk_open_station}
          </button>
        </div>
      </form>
      <div class="switches">
        <LanguageAndLight />
      </div>
    </main>
  );
}
