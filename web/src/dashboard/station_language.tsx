// In which language a station's kiosk starts, and the choice with which an engineer changes it.
import { type JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { setStationLanguage } from "../api/client";
import { isEngineer } from "../api/own_role";
import type { Language } from "../generated/api";
import { ProblemNotice } from "../shell/notices";
import { isLanguage, LANGUAGES, tagOf, words } from "../words/language";
import { useAction } from "./use_action";

interface Props {
  code: string;
  language: Language | null;
}

export function StationLanguage({ code, language }: Props): JSX.Element {
  const say = words.value;
  const change = useAction();
  // The list that the card comes from is asked for again only after a moment.
  const [saved, setSaved] = useState<Language | null | undefined>(undefined);
  useEffect(() => setSaved(undefined), [language]);
  const shown = saved === undefined ? language : saved;
  const choose = (value: string): void => {
    const wanted = isLanguage(value) ? value : null;
    setSaved(wanted);
    change.run(async () => {
      try {
        setSaved((await setStationLanguage(code, wanted)).language);
      } catch (error) {
        setSaved(undefined);
        throw error;
      }
    });
  };
  return (
    <div class="station-source">
      <span class="muted">{say.station_language}</span>
      <select
        class="station-change"
        aria-label={say.station_language_of(code)}
        value={shown ?? ""}
        disabled={change.isBusy || !isEngineer.value}
        onChange={(event) => choose(event.currentTarget.value)}
      >
        <option value="">{say.station_language_none}</option>
        {Object.entries(LANGUAGES).map(([name, texts]) => (
          <option key={name} value={name} {...(isLanguage(name) ? { lang: tagOf(name) } : {})}>
            {texts.language}
          </option>
        ))}
      </select>
      {change.problem !== null && <ProblemNotice problem={change.problem} />}
    </div>
  );
}
