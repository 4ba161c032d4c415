// A station's fixture, the fixed target in the vehicle frame: where it stands; an engineer sets and removes it.
import { type JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { setStationFixture } from "../api/client";
import { isEngineer } from "../api/own_role";
import type { FixtureDocument } from "../generated/api";
import { plain } from "../format/numbers";
import { ProblemNotice } from "../shell/notices";
import { QuestionBox } from "../shell/question_box";
import { words } from "../words/language";
import { FixtureForm } from "./fixture_form";
import { useAction } from "./use_action";

interface Props {
  code: string;
  fixture: FixtureDocument | null;
}

export function StationFixture({ code, fixture }: Props): JSX.Element {
  const say = words.value;
  const [isEdited, setEdited] = useState(false);
  // The list that the card comes from is asked for again only after a moment.
  const [saved, setSaved] = useState<FixtureDocument | null | undefined>(undefined);
  const given = JSON.stringify(fixture);
  useEffect(() => setSaved(undefined), [given]);
  const shown = saved === undefined ? fixture : saved;
  if (isEdited) {
    return (
      <div class="station-source">
        <span class="muted">{say.fixture}</span>
        <FixtureForm
          code={code}
          fixture={shown}
          onSaved={(now) => {
            setSaved(now);
            setEdited(false);
          }}
          onCancel={() => setEdited(false)}
        />
      </div>
    );
  }
  return (
    <div class="station-source">
      <span class="muted">{say.fixture}</span>
      {shown === null ? <span class="muted">{say.fixture_none}</span> : <Place fixture={shown} />}
      {isEngineer.value && (
        <span class="station-change fixture-actions">
          <button
            type="button"
            aria-label={`${shown === null ? say.fixture_set : say.station_source_change}: ${say.fixture_of(code)}`}
            onClick={() => setEdited(true)}
          >
            {shown === null ? say.fixture_set : say.station_source_change}
          </button>
          {shown !== null && <Remove code={code} onRemoved={() => setSaved(null)} />}
        </span>
      )}
    </div>
  );
}

function Place({ fixture }: { fixture: FixtureDocument }): JSX.Element {
  const say = words.value;
  const millimetres = fixture.pose.tvec.map((length) => plain(Number((1000 * length).toFixed(2))));
  return (
    <span class="fixture-place">
      <code>{fixture.target}</code> <span>{say.fixture_place(`(${millimetres.join(" / ")})`)}</span>
      <span class="muted">
        ± {plain(fixture.translation_sd_mm)} mm, ± {plain(fixture.rotation_sd_mdeg)} mdeg
      </span>
    </span>
  );
}

function Remove({ code, onRemoved }: { code: string; onRemoved: () => void }): JSX.Element {
  const say = words.value;
  const [isAsked, setAsked] = useState(false);
  const action = useAction();
  const remove = (): void =>
    action.run(async () => {
      await setStationFixture(code, null);
      onRemoved();
    });
  return (
    <>
      <button
        type="button"
        disabled={action.isBusy}
        aria-label={`${say.fixture_remove}: ${say.fixture_of(code)}`}
        onClick={() => setAsked(true)}
      >
        {say.fixture_remove}
      </button>
      {action.problem !== null && <ProblemNotice problem={action.problem} />}
      {isAsked && (
        <QuestionBox
          title={say.fixture_remove_ask}
          detail={say.fixture_remove_detail(code)}
          yes={say.fixture_remove}
          no={say.shape_leave}
          onYes={remove}
          onLeave={() => setAsked(false)}
        />
      )}
    </>
  );
}
