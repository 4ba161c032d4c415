// Where a station's frames come from, and the field in which an engineer changes it.
import { type JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { setStationSource } from "../api/client";
import { isEngineer } from "../api/own_role";
import { RequestFailed, type Problem } from "../api/problem";
import { ProblemNotice } from "../shell/notices";
import { words } from "../words/language";

interface Props {
  code: string;
  source: string;
}

export function StationSource({ code, source }: Props): JSX.Element {
  const say = words.value;
  const [isEdited, setEdited] = useState(false);
  // The list that the card comes from is asked for again only after a moment.
  const [saved, setSaved] = useState<string | null>(null);
  useEffect(() => setSaved(null), [source]);
  const shown = saved ?? source;
  return (
    <div class="station-source">
      <span class="muted">{say.station_source}</span>
      {isEdited ? (
        <SourceForm
          code={code}
          shown={shown}
          onSaved={(now) => {
            setSaved(now);
            setEdited(false);
          }}
          onCancel={() => setEdited(false)}
        />
      ) : (
        <>
          <code class="station-address">{shown}</code>
          {isEngineer.value && (
            <button
              type="button"
              class="station-change"
              aria-label={`${say.station_source_change}: ${say.station_source_of(code)}`}
              onClick={() => setEdited(true)}
            >
              {say.station_source_change}
            </button>
          )}
        </>
      )}
    </div>
  );
}

interface FormProps {
  code: string;
  shown: string;
  onSaved: (source: string) => void;
  onCancel: () => void;
}

function SourceForm({ code, shown, onSaved, onCancel }: FormProps): JSX.Element {
  const say = words.value;
  // What is masked cannot be sent back.
  const [typed, setTyped] = useState(shown.includes("***") ? "" : shown);
  const [problem, setProblem] = useState<Problem | null>(null);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => field.current?.focus(), []);
  const save = async (): Promise<void> => {
    try {
      onSaved((await setStationSource(code, typed.trim())).source);
    } catch (error) {
      if (!(error instanceof RequestFailed)) throw error;
      setProblem(error.problem);
    }
  };
  const submit = (event: SubmitEvent): void => {
    event.preventDefault();
    void save();
  };
  return (
    <form class="source-form" onSubmit={submit}>
      <input
        required
        maxLength={500}
        autocomplete="off"
        spellcheck={false}
        aria-label={say.station_source_of(code)}
        aria-describedby={`source-hint-${code}`}
        value={typed}
        ref={field}
        onInput={(event) => setTyped(event.currentTarget.value)}
      />
      <button type="submit" class="primary">
        {say.station_source_save}
      </button>
      <button type="button" onClick={onCancel}>
        {say.station_source_cancel}
      </button>
      <p id={`source-hint-${code}`} class="muted source-hint">
        {say.station_source_hint}
      </p>
      {problem !== null && <ProblemNotice problem={problem} />}
    </form>
  );
}
