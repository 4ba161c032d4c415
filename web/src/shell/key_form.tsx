// Asks for the API key when the address brought none, or when the service refused the one there was.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { rememberKey, refusal } from "../api/key";
import { words } from "../words/language";

export function KeyForm(): JSX.Element {
  const say = words.value;
  const [typed, setTyped] = useState("");
  const enter = (event: SubmitEvent): void => {
    event.preventDefault();
    if (typed.trim() !== "") rememberKey(typed.trim());
  };
  return (
    <form class="key-form panel" onSubmit={enter}>
      <h1>{say.key_title}</h1>
      <p>{say.key_explain}</p>
      {refusal.value !== null && (
        <p class="notice notice-problem" role="alert">
          <strong>{say.key_refused}</strong> <span lang="en">{refusal.value}</span>
        </p>
      )}
      <label for="key">{say.key_label}</label>
      <div class="key-row">
        <input
          id="key"
          type="password"
          required
          autocomplete="off"
          spellcheck={false}
          value={typed}
          ref={(input) => input?.focus()}
          onInput={(event) => setTyped(event.currentTarget.value)}
        />
        <button type="submit" class="primary">
          {say.key_enter}
        </button>
      </div>
    </form>
  );
}
