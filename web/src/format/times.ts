// Times for people: the clock of today, the date of other days. The wire has UTC, the screen the local zone.
import { language, type Language } from "../words/language";

/** Of the English orders of day and month only the one that cannot be misread. */
const LOCALES: Readonly<Record<Language, string>> = { en: "en-GB", de: "de-DE", zh: "zh-CN" };

export function localeOf(spoken: Language): string {
  return LOCALES[spoken];
}

function spoken(): string {
  return localeOf(language.value);
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

/** A day of the service's calendar, which is UTC, such as 2026-03-01: the same day in every zone. */
export function longDay(day: string, locale: string = spoken()): string {
  return new Date(`${day}T00:00:00Z`).toLocaleDateString(locale, {
    weekday: "short",
    day: "2-digit",
    month: "short",
    year: "numeric",
    timeZone: "UTC",
  });
}

export function shortDay(day: string, locale: string = spoken()): string {
  return new Date(`${day}T00:00:00Z`).toLocaleDateString(locale, {
    day: "2-digit",
    month: "short",
    timeZone: "UTC",
  });
}
