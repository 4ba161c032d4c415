// Hints as what an operator is told to do: a shift to the side and one up or down are one step, a slanting arrow.
import type { Words } from "../words/en";
import type { HintCode } from "./mirror";
import { hintText } from "./said";

export interface Step {
  code: HintCode;
  /** The other shift of a slanting one. */
  beside: HintCode | null;
}

const ACROSS: readonly HintCode[] = ["move-left", "move-right"];
const ALONG: readonly HintCode[] = ["move-up", "move-down"];

/** The steps of hints in their order; the service puts both shifts of a slanting one side by side. */
export function stepsOf(codes: readonly HintCode[]): Step[] {
  return codes.reduce<Step[]>((steps, code) => {
    const last = steps.at(-1);
    if (last?.beside !== null || !isSlanting(last.code, code)) return [...steps, { code, beside: null }];
    return [...steps.slice(0, -1), { ...last, beside: code }];
  }, []);
}

export function stepText({ code, beside }: Step, say: Words): string {
  if (beside === null) return hintText(code, say);
  const [across, along] = ACROSS.includes(code) ? [code, beside] : [beside, code];
  return hintText(`${across}-${along.replace("move-", "")}`, say);
}

function isSlanting(a: HintCode, b: HintCode): boolean {
  return (ACROSS.includes(a) && ALONG.includes(b)) || (ALONG.includes(a) && ACROSS.includes(b));
}
