// Which language the pages speak: chosen by hand, else the browser's, else English.
import { computed, signal } from "@preact/signals";
import { de } from "./de";
import { en, type Words } from "./en";
import { zh } from "./zh";

export const LANGUAGES = { en, de, zh } as const satisfies Record<string, Words>;
export type Language = keyof typeof LANGUAGES;

const STORED_AS = "dmscal.language";
const SWITCHED_AS = "dmscal.language.switched";

export function isLanguage(name: string | null | undefined): name is Language {
  return typeof name === "string" && Object.hasOwn(LANGUAGES, name);
}

export function firstLanguage(stored: string | null, wanted: readonly string[]): Language {
  if (isLanguage(stored)) return stored;
  return wanted.map((tag) => tag.slice(0, 2).toLowerCase()).find(isLanguage) ?? "en";
}

export const language = signal<Language>("en");
export const words = computed<Words>(() => LANGUAGES[language.value]);

/** Of the ways to write Chinese the one that the words are in, so that the browser takes its signs. */
export function tagOf(name: Language): string {
  return name === "zh" ? "zh-Hans" : name;
}

export function speak(name: Language): void {
  language.value = name;
  document.documentElement.lang = tagOf(name);
}

export function speakFirstLanguage(): void {
  speak(firstLanguage(localStorage.getItem(STORED_AS), navigator.languages));
}

export function chooseLanguage(name: Language): void {
  localStorage.setItem(STORED_AS, name);
  // Of this tab only: what somebody chose here today outdoes the station's language, what was chosen once does not.
  sessionStorage.setItem(SWITCHED_AS, "yes");
  speak(name);
}

/** A station's own language, unless somebody switched in this tab. */
export function languageAt(station: string | null, isSwitched: boolean, present: Language): Language {
  return isLanguage(station) && !isSwitched ? station : present;
}

export function speakAt(station: string | null): void {
  speak(languageAt(station, sessionStorage.getItem(SWITCHED_AS) !== null, language.value));
}

/** The one that a button leads to which goes round them all. */
export function nextLanguage(present: Language): Language {
  const all = Object.keys(LANGUAGES).filter(isLanguage);
  return all[(all.indexOf(present) + 1) % all.length] ?? "en";
}
