// Before a practice: whose it is. A badge is scanned or typed, or left out.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { words } from "../words/language";
import type { Kiosk } from "./kiosk";

export function PracticeEntry({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const say = words.value;
  const [badge, setBadge] = useState("");
  const begin = (event: SubmitEvent): void => {
    event.preventDefault();
    kiosk.practise(badge.trim());
  };
  return (
    <form class="serial-form" onSubmit={begin}>
      <p class="start-detail">{say.practice_detail}</p>
      <label for="badge">{say.practice_badge_hint}</label>
      <div class="serial-row">
        <input
          id="badge"
          class="serial-field"
          autocomplete="off"
          spellcheck={false}
          maxLength={80}
          aria-label={say.practice_badge}
          value={badge}
          ref={(input) => input?.focus()}
          onInput={(event) => setBadge(event.currentTarget.value)}
        />
        <button type="submit" class="act act-primary">
          {say.practice_start}
        </button>
        <button type="button" class="act" onClick={() => (kiosk.isPractising.value = false)}>
          {say.practice_leave}
        </button>
      </div>
    </form>
  );
}

export function PracticeDoor({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const hasSku = (kiosk.state.value.welcome?.skus.length ?? 0) > 0;
  if (!hasSku || kiosk.isPractising.value) return null;
  return (
    <button type="button" class="act start-practice" onClick={() => (kiosk.isPractising.value = true)}>
      {words.value.practice_open}
    </button>
  );
}
