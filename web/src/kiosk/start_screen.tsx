// Before a run: which vehicle, and, where there is a choice, which camera it has.
import { type JSX } from "preact";
import { useState } from "preact/hooks";
import { words } from "../words/language";
import type { Words } from "../words/en";
import type { Kiosk } from "./kiosk";
import type { Told } from "./kiosk_state";
import { PracticeDoor, PracticeEntry } from "./practice_entry";
import { problemText, sourceText } from "./said";
import { Switches } from "./switches";

export function StartScreen({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const say = words.value;
  const { welcome, problem } = kiosk.state.value;
  const skus = welcome?.skus ?? [];
  const isPractising = kiosk.isPractising.value;
  return (
    <main class="start">
      <section class="start-card">
        <p class="start-station">
          {say.kiosk_title} <b>{welcome?.name ?? kiosk.station}</b>
          {welcome !== null && <span> · {sourceText(welcome.source, say)}</span>}
        </p>
        <h1>{isPractising ? say.practice_title : say.start_title}</h1>
        {skus.length === 0 ? <NoSku say={say} /> : <Entry kiosk={kiosk} say={say} />}
        {skus.length > 1 && <SkuChoice kiosk={kiosk} skus={skus} say={say} />}
        {problem !== null && <StartProblem told={problem} say={say} />}
        <PracticeDoor kiosk={kiosk} />
      </section>
      <Switches kiosk={kiosk} isWhole />
    </main>
  );
}

function NoSku({ say }: { say: Words }): JSX.Element {
  return (
    <p class="start-none" role="alert">
      <strong>{say.start_no_sku}</strong> {say.start_no_sku_detail}
    </p>
  );
}

function Entry({ kiosk, say }: { kiosk: Kiosk; say: Words }): JSX.Element {
  return kiosk.isPractising.value ? <PracticeEntry kiosk={kiosk} /> : <SerialForm kiosk={kiosk} say={say} />;
}

function SerialForm({ kiosk, say }: { kiosk: Kiosk; say: Words }): JSX.Element {
  const [typed, setTyped] = useState("");
  const begin = (event: SubmitEvent): void => {
    event.preventDefault();
    if (typed.trim() !== "") kiosk.begin(typed.trim());
  };
  return (
    <form class="serial-form" onSubmit={begin}>
      <label for="serial">{say.start_detail}</label>
      <div class="serial-row">
        <input
          id="serial"
          class="serial-field"
          autocomplete="off"
          autocapitalize="characters"
          spellcheck={false}
          maxLength={200}
          aria-label={say.start_serial}
          value={typed}
          ref={(input) => input?.focus()}
          onInput={(event) => setTyped(event.currentTarget.value)}
        />
        <button type="submit" class="act act-primary" disabled={typed.trim() === ""}>
          {say.start_go}
        </button>
      </div>
    </form>
  );
}

interface SkuProps {
  kiosk: Kiosk;
  skus: readonly string[];
  say: Words;
}

function SkuChoice({ kiosk, skus, say }: SkuProps): JSX.Element {
  return (
    <fieldset class="sku-choice">
      <legend>{say.start_sku}</legend>
      {skus.map((code) => (
        <button
          key={code}
          type="button"
          class="act"
          aria-pressed={kiosk.sku.value === code}
          onClick={() => {
            kiosk.setSku(code);
            document.querySelector<HTMLInputElement>(".serial-field")?.focus();
          }}
        >
          {code}
        </button>
      ))}
    </fieldset>
  );
}

function StartProblem({ told, say }: { told: Told; say: Words }): JSX.Element {
  const { title, detail, isTranslated } = problemText(told, say);
  return (
    <div
      class="start-problem"
      role="alert"
      data-problem={told.code}
      {...(isTranslated ? {} : { lang: "en" })}
    >
      <strong>{title}</strong>
      <p>{detail}</p>
    </div>
  );
}
