// What a measurement says, in the language of the page. Unknown codes (a newer service, an older result) stay as
// the service said them, in English. Not here: the sentences (advice_en, advice_de, advice_zh).
import { percent } from "../format/numbers";
import { adviceDe } from "./advice_de";
import { adviceEn } from "./advice_en";
import { adviceZh } from "./advice_zh";
import type { Words } from "./en";
import type { Language } from "./language";

/** What a sentence may name. */
export interface About {
  /** Views, as a list in words; empty where none is named. */
  views: string;
  /** Poses, likewise. */
  poses: string;
  fact: (name: string) => string;
  /** A share, as per cent. */
  share: (name: string) => string;
}

export type Text = string | ((about: About) => string);

/** `bad` and `remedy` are missing where a value is only reported. */
export interface Advice {
  good: Text;
  bad?: Text;
  remedy?: Text;
}

/** What is needed of a measurement, over REST and over the socket. */
export interface Judged {
  verdict: string;
  margin: number | null;
  advice: string;
  reason: string | null;
  facts: Record<string, unknown> | null;
}

export interface Said {
  /** What is wrong; empty where nothing is, or where it is only close to its limit. */
  wrong: string;
  remedy: string;
  /** All of it: what PASS means, or what is wrong, and what to do. */
  all: string;
  /** The language that it is in. */
  lang: Language;
}

const ADVICE: Readonly<Record<Language, Readonly<Record<string, Advice>>>> = {
  en: adviceEn,
  de: adviceDe,
  zh: adviceZh,
};

export function adviceOf(measurement: Judged, language: Language, say: Words): Said {
  const found = measurement.reason === null ? undefined : ADVICE[language][measurement.reason];
  if (found === undefined) return { wrong: "", remedy: "", all: measurement.advice, lang: "en" };
  const about = aboutOf(measurement.facts ?? {}, language, say);
  const remedy = told(found.remedy, about);
  if (measurement.verdict === "PASS")
    return { wrong: "", remedy: "", all: told(found.good, about), lang: language };
  const isClose = measurement.margin !== null && measurement.margin >= 0;
  if (isClose) return { wrong: "", remedy, all: `${say.advice_close} ${remedy}`, lang: language };
  const wrong = told(found.bad, about);
  return { wrong, remedy, all: `${wrong} ${remedy}`, lang: language };
}

function told(text: Text | undefined, about: About): string {
  return typeof text === "function" ? text(about) : (text ?? "");
}

function aboutOf(facts: Record<string, unknown>, language: Language, say: Words): About {
  const list = (name: string, worded: (one: unknown) => string): string => {
    const names = Array.isArray(facts[name]) ? facts[name].map(worded) : [];
    const more = Number(facts["more"] ?? 0);
    return [...names, ...(more > 0 ? [say.advice_more(more)] : [])].join(", ");
  };
  return {
    views: list("views", (view) => viewName(String(view), say)),
    poses: list("poses", (pose) => say.pose_number(Number(pose))),
    fact: (name) => plainly(facts[name]),
    share: (name) => percent(Number(facts[name] ?? Number.NaN), language),
  };
}

function plainly(fact: unknown): string {
  return typeof fact === "string" || typeof fact === "number" ? String(fact) : "?";
}

/** Views are named by capture and file, and files of a guided run by their pose. */
function viewName(name: string, say: Words): string {
  const pose = /^(?:\d+ )?pose-0*(\d+)\.png$/.exec(name)?.[1];
  if (pose !== undefined) return say.pose_number(Number(pose));
  return name === "" ? say.advice_unnamed : name;
}
