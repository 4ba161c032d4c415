// Codes of the service in the words of the language. What is not translated yet stays as the service said it.
import type { Words } from "../words/en";
import type { Told } from "./kiosk_state";
import type { HintCode } from "./mirror";

export function hintText(code: HintCode, say: Words): string {
  return textOf(`hint_${code.replaceAll("-", "_")}`, say) ?? code.replaceAll("-", " ");
}

export interface Said {
  title: string;
  detail: string;
  isTranslated: boolean;
}

export function problemText({ code, title, detail, facts }: Told, say: Words): Said {
  if (code === "other-sku-open") {
    const sku = typeof facts?.["sku"] === "string" ? facts["sku"] : "";
    return { title: say.told_other_sku, detail: say.told_other_sku_detail(sku), isTranslated: true };
  }
  if (code === "run-open-here") {
    return { title: say.told_run_open, detail: say.told_run_open_detail(detail), isTranslated: true };
  }
  const key = code.replaceAll("-", "_");
  const camera = textOf(key, say);
  if (camera !== null) return { title: say.camera_title, detail: camera, isTranslated: true };
  const known = textOf(`told_${key}`, say);
  if (known === null) return { title, detail, isTranslated: false };
  return { title: known, detail: textOf(`told_${key}_do`, say) ?? detail, isTranslated: true };
}

/** What to do when a gate of this family was not passed. */
export function remedyOf(gate: string, say: Words): string | null {
  return textOf(`remedy_${gate}`, say);
}

function textOf(key: string, say: Words): string | null {
  const text: unknown = (say as Record<string, unknown>)[key];
  return typeof text === "string" ? text : null;
}
