// Which language the pages speak: chosen by hand, else the browser's, else English.
import { computed, signal } from "@preact/signals";
import { de } from "./de";
import { en, type Words } from "./en";

export const LANGUAGES = { en, de } as const satisfies Record<string, Words>;
export type Language = keyof typeof LANGUAGES;

const STORED_AS = "dmscal.language";

export function isLanguage(name: string | null | undefined): name is Language {
  return name === "en" || name === "de";
}

export function firstLanguage(stored: string | null, wanted: readonly string[]): Language {
  if (isLanguage(stored)) return stored;
  return wanted.map((tag) => tag.slice(0, 2).toLowerCase()).find(isLanguage) ?? "en";
}

export const language = signal<Language>("en");
export const words = computed<Words>(() => LANGUAGES[language.value]);

export function speak(name: Language): void {
  language.value = name;
  document.documentElement.lang = name;
}

export function speakFirstLanguage(): void {
  speak(firstLanguage(localStorage.getItem(STORED_AS), navigator.languages));
}

export function chooseLanguage(name: Language): void {
  localStorage.setItem(STORED_AS, name);
  speak(name);
}
