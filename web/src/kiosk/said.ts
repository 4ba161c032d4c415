// Codes of the service in the words of the language. What is not translated yet stays as the service said it.
import type { Words } from "../words/en";
import type { Told } from "./kiosk_state";

export function hintText(code: string, say: Words): string {
  return textOf(`hint_${code.replaceAll("-", "_")}`, say) ?? code.replaceAll("-", " ");
}

export interface Said {
  title: string;
  detail: string;
  isTranslated: boolean;
}

export function problemText(told: Told, say: Words): Said {
  const { code, title, detail } = told;
  const named = namedText(told, say);
  if (named !== null) return named;
  const key = code.replaceAll("-", "_");
  const camera = textOf(key, say);
  if (camera !== null) return { title: say.camera_title, detail: camera, isTranslated: true };
  const known = textOf(`told_${key}`, say);
  if (known === null) return { title, detail, isTranslated: false };
  return { title: known, detail: textOf(`told_${key}_do`, say) ?? detail, isTranslated: true };
}

/** Problems whose words name something; null for others. */
function namedText({ code, detail, facts }: Told, say: Words): Said | null {
  if (code === "other-sku-open") {
    const sku = typeof facts?.["sku"] === "string" ? facts["sku"] : "";
    return { title: say.told_other_sku, detail: say.told_other_sku_detail(sku), isTranslated: true };
  }
  if (code === "run-open-here") {
    return { title: say.told_run_open, detail: say.told_run_open_detail(detail), isTranslated: true };
  }
  const hint = code === "picture-unfit" ? facts?.["hint"] : undefined;
  if (typeof hint !== "string") return null;
  const what = textOf(`hint_${hint.replaceAll("-", "_")}`, say)?.replaceAll("*", "");
  return { title: say.told_picture_unfit, detail: what ?? say.told_picture_unfit_do, isTranslated: true };
}

/** Where the pictures come from; a kind that a newer service knows stays as it is called. */
export function sourceText(source: string, say: Words): string {
  return textOf(`source_${source}`, say) ?? source;
}

/** What to do when a gate of this family was not passed. */
export function remedyOf(gate: string, say: Words): string | null {
  return textOf(`remedy_${gate}`, say);
}

function textOf(key: string, say: Words): string | null {
  const text: unknown = (say as Record<string, unknown>)[key];
  return typeof text === "string" ? text : null;
}
