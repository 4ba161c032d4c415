// Beside the picture: whose run it is, how far it is, how good the match, and what the hands can press.
import { type JSX } from "preact";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { AccuracyBar } from "./accuracy_bar";
import { AddedPoseNote } from "./added_pose_note";
import type { Kiosk } from "./kiosk";
import { isFinishing, isOnline } from "./kiosk_state";
import { PurposeTag } from "./purpose_tag";
import { PoseTiles } from "./pose_tiles";
import { Switches } from "./switches";

export function SideColumn({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const say = words.value;
  const { run, live } = kiosk.state.value;
  if (run === null) return null;
  const askRetake = (pose_index: number): void => {
    kiosk.question.value = { kind: "retake", pose_index };
  };
  return (
    <aside class="side">
      <header class="whose">
        <h1 class="whose-serial">{run.serial}</h1>
        <span class="whose-sku">
          {run.sku} · {kiosk.state.value.welcome?.name ?? kiosk.station} <PurposeTag purpose={run.purpose} />
        </span>
        <span class="count" aria-label={say.guide_of(run.captured.length, run.total)}>
          <b>{run.captured.length}</b>/{run.total}
        </span>
      </header>
      <div class="poses">
        <AddedPoseNote run={run} say={say} />
        <PoseTiles run={run} isMirrored={kiosk.mirrored.value} onRetake={askRetake} />
      </div>
      <Match
        share={live?.match ?? 0}
        isHeld={(live?.dwell ?? 0) > 0 || live?.is_capturing === true}
        say={say}
      />
      <AccuracyBar estimate={run.estimate} say={say} />
      <Actions kiosk={kiosk} say={say} />
      <Switches kiosk={kiosk} />
    </aside>
  );
}

function Match({ share, isHeld, say }: { share: number; isHeld: boolean; say: Words }): JSX.Element {
  const percent = Math.round(100 * share);
  return (
    <div class="match">
      <span id="match-name">{say.guide_match}</span>
      <span class="match-value">{percent} %</span>
      <div
        class={`match-bar ${isHeld || share >= 1 ? "match-good" : ""}`}
        role="meter"
        aria-labelledby="match-name"
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={percent}
      >
        <div class="match-fill" style={{ width: `${percent}%` }} />
      </div>
    </div>
  );
}

function Actions({ kiosk, say }: { kiosk: Kiosk; say: Words }): JSX.Element {
  const state = kiosk.state.value;
  const isReady = isOnline(state) && !isFinishing(state);
  const hasCapture = (state.run?.captured.length ?? 0) > 0;
  const isAutomatic = state.run?.automatic ?? true;
  return (
    <div class="acts">
      <button type="button" class="act act-capture" disabled={!isReady} onClick={() => kiosk.capture()}>
        {say.act_capture} <kbd>{say.act_capture_key}</kbd>
      </button>
      <button
        type="button"
        class="act"
        aria-pressed={isAutomatic}
        disabled={!isReady}
        onClick={() => kiosk.setAutomatic(!isAutomatic)}
      >
        {say.act_automatic} <kbd>{isAutomatic ? say.state_on : say.state_off}</kbd>
      </button>
      <button type="button" class="act" disabled={!isReady || !hasCapture} onClick={() => kiosk.undo()}>
        {say.act_undo} <kbd>{say.act_undo_key}</kbd>
      </button>
      <button
        type="button"
        class="act act-abort"
        disabled={!isReady}
        onClick={() => (kiosk.question.value = { kind: "abort" })}
      >
        {say.act_abort} <kbd>{say.act_abort_key}</kbd>
      </button>
    </div>
  );
}
