// Numbers for people: fixed digits, a real minus sign, the language's decimal mark.
import { language } from "../words/language";

const NOTHING = "–";

export function fixed(
  value: number | null | undefined,
  digits: number,
  locale: string = language.value,
): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NOTHING;
  const text = value.toLocaleString(locale, {
    minimumFractionDigits: digits,
    maximumFractionDigits: digits,
    useGrouping: false,
  });
  return text.replace("-", "−");
}

const TINY = 1e-4;
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** As many digits as give about three that count: 1.2·10⁻⁶, 0.00084, 0.163, 12.4, 1350. */
export function significant(value: number | null | undefined, locale: string = language.value): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NOTHING;
  if (value === 0 || Number.isInteger(value)) return fixed(value, 0, locale);
  const magnitude = Math.floor(Math.log10(Math.abs(value)));
  if (Math.abs(value) < TINY) return `${fixed(value / 10 ** magnitude, 1, locale)}·10⁻${raised(-magnitude)}`;
  return fixed(value, Math.min(6, Math.max(0, 2 - magnitude)), locale);
}

function raised(exponent: number): string {
  return String(exponent).replace(/\d/g, (digit) => RAISED.charAt(Number(digit)));
}

/** A number as somebody wrote it, such as a limit: no digit is added. */
export function plain(value: number, locale: string = language.value): string {
  if (value !== 0 && Math.abs(value) < 1e-6) return significant(value, locale);
  return value.toLocaleString(locale, { maximumFractionDigits: 6, useGrouping: false }).replace("-", "−");
}

/** Digits after the mark that make an estimate end where its sd begins: two digits of the sd. */
export function digitsForSd(sd: number | null | undefined): number {
  if (sd === null || sd === undefined || !Number.isFinite(sd) || sd <= 0) return 4;
  return Math.min(7, Math.max(1, 1 - Math.floor(Math.log10(sd))));
}

export function signed(value: number, digits: number, locale: string = language.value): string {
  return value < 0 ? fixed(value, digits, locale) : `+${fixed(value, digits, locale)}`;
}

export function withUnit(text: string, unit: string): string {
  return unit === "" || text === NOTHING ? text : `${text} ${unit}`;
}

export function percent(share: number, locale: string = language.value): string {
  return `${fixed(100 * share, 0, locale)} %`;
}
