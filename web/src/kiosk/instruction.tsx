// The strip under the picture: one instruction, large; the next one small; or what went wrong and what to do.
import { type JSX } from "preact";
import type { State, WantedPose } from "../generated/protocol";
import { words } from "../words/language";
import type { Words } from "../words/en";
import { helpText } from "./help_text";
import type { Kiosk } from "./kiosk";
import { isFinishing, type KioskState, type Told } from "./kiosk_state";
import { Marked } from "./marked";
import { hintOnDisplay, type HintCode } from "./mirror";
import { Pictogram } from "./pictogram";
import { problemText } from "./said";
import { stepsOf, stepText, type Step } from "./steps";

export function Instruction({ kiosk }: { kiosk: Kiosk }): JSX.Element {
  const state = kiosk.state.value;
  const say = words.value;
  if (state.problem !== null)
    return <Trouble told={state.problem} say={say} onRead={() => kiosk.readProblem()} />;
  if (isFinishing(state)) return <Note text={say.guide_finishing} isBusy />;
  const refused = state.refused.capture;
  if (refused !== null) {
    const canForce = state.welcome?.may_override === true && isForceable(refused.code);
    const force = canForce ? { onForce: () => kiosk.captureAnyway() } : {};
    return <Trouble told={refused} say={say} isRefusal {...force} />;
  }
  if (state.live === null) return <Note text={say.guide_waiting} isBusy />;
  if (state.live.is_capturing) return <Hint kiosk={kiosk} state={state} say={say} codes={["hold"]} />;
  const codes = state.live.hints.map(({ code }) => hintOnDisplay(code, kiosk.mirrored.value));
  return <Hint kiosk={kiosk} state={state} say={say} codes={codes} />;
}

interface HintProps {
  kiosk: Kiosk;
  state: KioskState;
  say: Words;
  codes: HintCode[];
}

function Hint({ kiosk, state, say, codes }: HintProps): JSX.Element {
  const [step, next] = stepsOf(codes);
  const { live, run } = state;
  if (step === undefined || live === null) return <Note text={say.guide_manual} />;
  const { code, beside } = step;
  const pose = run?.poses.find(({ pose_index }) => pose_index === live.pose_index) ?? null;
  const isHeld = live.is_capturing || code === "hold" || code === "hold-still";
  return (
    <section class={`strip ${isHeld ? "strip-good" : "strip-move"}`} data-hint={code} data-beside={beside}>
      <Pictogram
        code={code}
        beside={beside}
        wanted={pose?.angles ?? null}
        difference={live.difference}
        dwell={live.is_capturing ? 1 : live.dwell}
        isMirrored={kiosk.mirrored.value}
      />
      <div class="strip-words">
        <p class="strip-main" role="status">
          <Marked text={stepText(step, say)} />
        </p>
        <p class="strip-next">{detailOf(step, next, live, pose, say)}</p>
      </div>
    </section>
  );
}

function detailOf(
  step: Step,
  next: Step | undefined,
  live: State,
  pose: WantedPose | null,
  say: Words,
): string {
  const { code } = step;
  if (live.is_capturing) return say.guide_capturing;
  const help = helpText(code, live, say, pose);
  if (help !== null) return help;
  if (code === "turn-upside-down") return say.guide_dot_into_ring;
  if (code === "wrong-board") return say.guide_wrong_board;
  return next === undefined ? "" : `${say.guide_next}: ${stepText(next, say).replaceAll("*", "")}`;
}

function Note({ text, isBusy = false }: { text: string; isBusy?: boolean }): JSX.Element {
  return (
    <section class="strip strip-note">
      {isBusy && <span class="spinner strip-spinner" aria-hidden="true" />}
      <p class="strip-main" role="status">
        {text}
      </p>
    </section>
  );
}

/** What the checks of a picture refuse; anything else is no matter of opinion. */
function isForceable(code: string): boolean {
  return code === "pose-not-matched" || code === "picture-unfit";
}

interface TroubleProps {
  told: Told;
  say: Words;
  isRefusal?: boolean;
  onRead?: () => void;
  onForce?: () => void;
}

function Trouble({ told, say, isRefusal = false, onRead, onForce }: TroubleProps): JSX.Element {
  const { title, detail, isTranslated } = problemText(told, say);
  const lang = isTranslated ? {} : { lang: "en" };
  return (
    <section class="strip strip-trouble" role="alert" data-problem={told.code}>
      <svg class="strip-sign" viewBox="0 0 24 24" aria-hidden="true">
        <path class="trouble-shape" d="M12 2 L23 21.5 H1 Z" />
        <path class="trouble-mark" d="M12 9 V14.5 M12 17.6 V17.7" />
      </svg>
      <div class="strip-words">
        <p class="strip-main strip-problem" {...lang}>
          {isRefusal && `${say.refused_title}: `}
          {title}
        </p>
        <p class="strip-next" {...lang}>
          {detail}
        </p>
      </div>
      {onForce !== undefined && (
        <button type="button" class="act" onClick={onForce}>
          {say.help_override}
        </button>
      )}
      {onRead !== undefined && (
        <button type="button" class="act" onClick={onRead}>
          {say.problem_read}
        </button>
      )}
    </section>
  );
}
