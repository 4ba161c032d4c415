// The whole kiosk page: which screen is on show.
import { type JSX } from "preact";
import { useEffect, useMemo, useState } from "preact/hooks";
import { key } from "../api/key";
import { KeyForm } from "../shell/key_form";
import { words } from "../words/language";
import { ClosedScreen } from "./closed_screen";
import { Instruction } from "./instruction";
import { Kiosk } from "./kiosk";
import { isOnline, screenOf } from "./kiosk_state";
import { IdleScreen } from "./idle_screen";
import { PracticeBar } from "./practice_bar";
import { PracticeResult } from "./practice_result";
import { PictogramHead } from "./pictogram";
import { QuestionBox } from "./question";
import { SideColumn } from "./side_column";
import { Stage } from "./stage";
import { StartScreen } from "./start_screen";
import { StationForm } from "./station_form";
import { useAwakeScreen } from "./use_awake_screen";
import { useIdle } from "./use_idle";
import { useKeys } from "./use_keys";
import { usePractice } from "./use_practice";
import { useSpeech } from "./use_speech";
import { VerdictScreen } from "./verdict_screen";

export function App({ named }: { named: string | null }): JSX.Element {
  const [station, setStation] = useState(named);
  if (station === null) {
    return (
      <div class="kiosk">
        <StationForm onChosen={(code) => setStation(nameStation(code))} />
      </div>
    );
  }
  if (key.value === null) {
    return (
      <main>
        <KeyForm />
      </main>
    );
  }
  return <Station key={station} station={station} apiKey={key.value} />;
}

/** A reload finds the station again. */
function nameStation(code: string): string {
  window.history.replaceState(null, "", `?${new URLSearchParams({ station: code }).toString()}`);
  return code;
}

function Station({ station, apiKey }: { station: string; apiKey: string }): JSX.Element {
  const kiosk = useMemo(() => new Kiosk(station, apiKey), [station, apiKey]);
  useEffect(() => {
    kiosk.start();
    return () => kiosk.stop();
  }, [kiosk]);
  useKeys(kiosk);
  useAwakeScreen();
  useIdle(kiosk);
  usePractice(kiosk);
  useSpeech(kiosk);
  useEffect(() => {
    document.title = `${station} · ${words.value.product}`;
  }, [station]);
  return (
    <div class="kiosk" onClick={letGo}>
      <PictogramHead />
      <Bar kiosk={kiosk} />
      <Shown kiosk={kiosk} />
      <IdleScreen kiosk={kiosk} />
    </div>
  );
}

/** A button that was pressed gives the focus back, so that the foot switch captures and presses nothing again. */
function letGo(event: MouseEvent): void {
  if (event.target instanceof Element) event.target.closest("button")?.blur();
}

function Shown({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const state = kiosk.state.value;
  switch (screenOf(state)) {
    case "closed":
      return (
        <ClosedScreen kiosk={kiosk} code={state.connection.kind === "lost" ? state.connection.code : 0} />
      );
    case "start":
      return <StartScreen kiosk={kiosk} />;
    case "guide":
      return <Guide kiosk={kiosk} />;
    case "verdict":
      return <Result kiosk={kiosk} />;
    case "connecting":
      return <Connecting />;
  }
}

function Result({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const { verdict } = kiosk.state.value;
  const practice = kiosk.practice.value;
  if (verdict === null) return <Connecting />;
  if (practice === null) return <VerdictScreen kiosk={kiosk} verdict={verdict} />;
  return <PracticeResult key={verdict.run_id} kiosk={kiosk} practice={practice} verdict={verdict} />;
}

function Guide({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  return (
    <main class={kiosk.practice.value === null ? "guide" : "guide guide-practice"}>
      <PracticeBar kiosk={kiosk} />
      <Stage kiosk={kiosk} />
      <Instruction kiosk={kiosk} />
      <SideColumn kiosk={kiosk} />
      <QuestionBox kiosk={kiosk} />
    </main>
  );
}

function Connecting(): JSX.Element {
  return (
    <main class="start">
      <p class="start-detail" role="status">
        {words.value.kiosk_connecting}
      </p>
    </main>
  );
}

function Bar({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const state = kiosk.state.value;
  const say = words.value;
  const screen = screenOf(state);
  if (isOnline(state) || screen === "closed" || screen === "connecting") return null;
  return (
    <div class="lost" role="alert">
      <strong>{say.lost_title}</strong>
      <span>{say.lost_detail}</span>
    </div>
  );
}
