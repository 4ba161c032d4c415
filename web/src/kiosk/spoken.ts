// What a voice would say of the screen: the instruction, a problem with what to do, the result. Null: nothing.
import type { Words } from "../words/en";
import { isFinishing, screenOf, type KioskState, type Told } from "./kiosk_state";
import { hintOnDisplay } from "./mirror";
import { isPractice } from "./practice";
import { problemText } from "./said";
import { stepsOf, stepText } from "./steps";

export function spokenOf(state: KioskState, isMirrored: boolean, say: Words): string | null {
  if (state.problem !== null) return told(state.problem, say);
  const screen = screenOf(state);
  if (screen === "verdict") return verdictOf(state, say);
  if (screen !== "guide") return null;
  if (isFinishing(state)) return say.guide_finishing;
  if (state.refused.capture !== null) return told(state.refused.capture, say);
  const hints = state.live?.is_capturing === true ? [] : (state.live?.hints ?? []);
  const [step] = stepsOf(hints.map(({ code }) => hintOnDisplay(code, isMirrored)));
  return step === undefined ? null : stepText(step, say).replaceAll("*", "");
}

/** What is not translated stays unsaid: the voice speaks one language. */
function told(problem: Told, say: Words): string | null {
  const { title, detail, isTranslated } = problemText(problem, say);
  return isTranslated ? `${title}. ${detail}` : null;
}

function verdictOf({ verdict, run }: KioskState, say: Words): string | null {
  if (verdict === null) return null;
  if (isPractice(run)) return say.practice_done;
  return `${say[`verdict_${verdict.verdict}`]}. ${say[`verdict_do_${verdict.verdict}`]}`;
}
