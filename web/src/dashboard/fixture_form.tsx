// The form of a station's fixture. What the service refuses is told at its field, all else above the form.
import { type JSX } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";
import { setStationFixture } from "../api/client";
import type { Problem } from "../api/problem";
import type { FixtureDocument } from "../generated/api";
import { ProblemNotice } from "../shell/notices";
import { words } from "../words/language";
import { AXES, fixtureOf, isOfFields, POINTERS, textsOf, wrongAt, type FixtureTexts } from "./fixture_fields";
import { useAction } from "./use_action";

interface Props {
  code: string;
  /** As it is now; null: none. */
  fixture: FixtureDocument | null;
  onSaved: (fixture: FixtureDocument | null) => void;
  onCancel: () => void;
}

export function FixtureForm({ code, fixture, onSaved, onCancel }: Props): JSX.Element {
  const say = words.value;
  const hint = useId();
  // The card is drawn again and again while somebody types.
  const [before] = useState(fixture);
  const [texts, setTexts] = useState<FixtureTexts>(() => textsOf(before));
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.querySelector("input")?.focus(), []);
  const action = useAction();
  const { problem } = action;
  useEffect(() => {
    form.current?.querySelector<HTMLInputElement>("[aria-invalid]")?.focus();
  }, [problem]);
  const change = (part: Partial<FixtureTexts>): void => setTexts({ ...texts, ...part });
  const submit = (event: SubmitEvent): void => {
    event.preventDefault();
    action.run(async () => onSaved((await setStationFixture(code, fixtureOf(texts, before))).fixture));
  };
  return (
    <form
      ref={form}
      class="fixture-form"
      aria-label={say.fixture_of(code)}
      aria-describedby={hint}
      onSubmit={submit}
    >
      <p id={hint} class="muted">
        {say.fixture_hint}
      </p>
      {problem !== null && !isOfFields(problem) && <ProblemNotice problem={problem} />}
      <Field
        label={say.fixture_target}
        value={texts.target}
        placeholder={say.fixture_target_hint}
        wrong={wrongAt(problem, POINTERS.target)}
        onChange={(target) => change({ target })}
      />
      <Axes
        title={say.fixture_position}
        label={say.fixture_position_axis}
        values={texts.position}
        unit="m"
        wrong={(axis) => wrongAt(problem, POINTERS.position(axis))}
        onChange={(position) => change({ position })}
      />
      <Axes
        title={say.fixture_rotation}
        label={say.fixture_rotation_axis}
        values={texts.rotation}
        unit="rad"
        wrong={(axis) => wrongAt(problem, POINTERS.rotation(axis))}
        onChange={(rotation) => change({ rotation })}
      />
      <Certainty texts={texts} problem={problem} change={change} />
      <div class="fixture-buttons">
        <button type="submit" class="primary" disabled={action.isBusy}>
          {say.station_source_save}
        </button>
        <button type="button" onClick={onCancel}>
          {say.station_source_cancel}
        </button>
      </div>
    </form>
  );
}

interface CertaintyProps {
  texts: FixtureTexts;
  problem: Problem | null;
  change: (part: Partial<FixtureTexts>) => void;
}

function Certainty({ texts, problem, change }: CertaintyProps): JSX.Element {
  const say = words.value;
  return (
    <fieldset>
      <legend>{say.fixture_certainty}</legend>
      <Field
        isNumber
        label={say.fixture_translation_sd}
        value={texts.translationSd}
        wrong={wrongAt(problem, POINTERS.translationSd)}
        onChange={(translationSd) => change({ translationSd })}
      />
      <Field
        isNumber
        label={say.fixture_rotation_sd}
        value={texts.rotationSd}
        wrong={wrongAt(problem, POINTERS.rotationSd)}
        onChange={(rotationSd) => change({ rotationSd })}
      />
    </fieldset>
  );
}

interface AxesProps {
  title: string;
  label: (axis: string) => string;
  values: FixtureTexts["position"];
  /** Of the numbers that the service speaks of. */
  unit: "m" | "rad";
  wrong: (axis: number) => string | null;
  onChange: (values: FixtureTexts["position"]) => void;
}

function Axes({ title, label, values, unit, wrong, onChange }: AxesProps): JSX.Element {
  const set = (at: number, value: string): void => {
    const [x, y, z] = values;
    onChange([at === 0 ? value : x, at === 1 ? value : y, at === 2 ? value : z]);
  };
  return (
    <fieldset>
      <legend>{title}</legend>
      {AXES.map((axis, i) => (
        <Field
          key={axis}
          isNumber
          short={axis}
          label={label(axis)}
          value={values[i] ?? ""}
          wrong={withUnit(wrong(i), unit)}
          onChange={(value) => set(i, value)}
        />
      ))}
    </fieldset>
  );
}

function withUnit(wrong: string | null, unit: string): string | null {
  return wrong === null ? null : `${wrong} (${unit})`;
}

interface FieldProps {
  label: string;
  /** What stands before the field, where the label is long. */
  short?: string;
  value: string;
  placeholder?: string;
  isNumber?: boolean;
  /** What the service says is wrong with it. */
  wrong: string | null;
  onChange: (value: string) => void;
}

function Field({ label, short, value, placeholder, isNumber, wrong, onChange }: FieldProps): JSX.Element {
  const id = useId();
  const common = {
    id,
    required: true,
    autocomplete: "off",
    "aria-invalid": wrong === null ? undefined : ("true" as const),
    "aria-describedby": wrong === null ? undefined : `${id}-wrong`,
    value,
    onInput: (event: InputEvent & { currentTarget: HTMLInputElement }) => onChange(event.currentTarget.value),
  };
  return (
    <div class="fixture-field">
      <label for={id}>
        {short === undefined ? (
          label
        ) : (
          <>
            <span aria-hidden="true">{short}</span>
            <span class="visually-hidden">{label}</span>
          </>
        )}
      </label>
      {isNumber === true ? (
        <input type="number" step="any" {...common} />
      ) : (
        <input type="text" maxLength={60} spellcheck={false} placeholder={placeholder} {...common} />
      )}
      {wrong !== null && (
        // Problem documents come from the service, which speaks English.
        <p id={`${id}-wrong`} class="field-wrong" lang="en">
          {wrong}
        </p>
      )}
    </div>
  );
}
