// Times for people: the clock of today, the date of other days. The wire has UTC, the screen the local zone.
import { language, type Language } from "../words/language";

/** Of the English orders of day and month only the one that cannot be misread. */
const LOCALES: Readonly<Record<Language, string>> = { en: "en-GB", de: "de-DE" };

function spoken(): string {
  return LOCALES[language.value];
}

export function when(iso: string, now: Date = new Date(), locale: string = spoken()): string {
  const time = new Date(iso);
  const clock = time.toLocaleTimeString(locale, { hour: "2-digit", minute: "2-digit", hourCycle: "h23" });
  if (time.toDateString() === now.toDateString()) return clock;
  const day = time.toLocaleDateString(locale, { day: "2-digit", month: "short", year: "numeric" });
  return `${day}, ${clock}`;
}

export function exactly(iso: string, locale: string = spoken()): string {
  return new Date(iso).toLocaleString(locale, {
    day: "2-digit",
    month: "short",
    year: "numeric",
    hour: "2-digit",
    minute: "2-digit",
    second: "2-digit",
    hourCycle: "h23",
  });
}

export function clock(time: Date, locale: string = spoken()): string {
  return time.toLocaleTimeString(locale, {
    hour: "2-digit",
    minute: "2-digit",
    second: "2-digit",
    hourCycle: "h23",
  });
}
