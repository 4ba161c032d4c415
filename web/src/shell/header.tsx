// The head of every page: where you are, language, brightness, key; and the bar that says the service is away.
import { type JSX } from "preact";
import { online } from "../api/connection";
import { forgetKey, key } from "../api/key";
import { chooseTheme, theme, THEMES, type Theme } from "../look/theme";
import { chooseLanguage, isLanguage, language, LANGUAGES, words } from "../words/language";
import type { Words } from "../words/en";

/** `page` is the page on show, as the addresses name it. */
export function Header({ page }: { page: string }): JSX.Element {
  const say = words.value;
  return (
    <header class="bar">
      <a class="skip" href="#content" onClick={focusContent}>
        {say.skip_to_content}
      </a>
      <a class="brand" href="#/runs">
        <Logo />
        <b>{say.product}</b>
        <span class="brand-tagline">{say.tagline}</span>
      </a>
      <nav aria-label={say.product}>
        {linksOf(say).map(({ name, href, pages }) => (
          <a key={href} href={href} aria-current={pages.includes(page) ? "page" : undefined}>
            {name}
          </a>
        ))}
        <a href="/api/docs">{say.api_docs}</a>
      </nav>
      <div class="bar-controls">
        <LanguageChoice />
        <ThemeChoice say={say} />
        {key.value !== null && (
          <button type="button" class="bar-button" onClick={forgetKey}>
            {say.forget_key}
          </button>
        )}
      </div>
    </header>
  );
}

interface Link {
  name: string;
  href: string;
  /** Pages that belong under the link. */
  pages: readonly string[];
}

function linksOf(say: Words): Link[] {
  return [
    { name: say.nav_stations, href: "#/stations", pages: ["stations"] },
    { name: say.nav_runs, href: "#/runs", pages: ["runs", "run", "vehicle", "compare"] },
    { name: say.nav_skus, href: "#/skus", pages: ["skus", "sku", "poseSet"] },
    { name: say.nav_targets, href: "#/targets", pages: ["targets", "target", "board"] },
    { name: say.nav_yield, href: "#/yield", pages: ["yield"] },
  ];
}

function focusContent(event: MouseEvent): void {
  // The hash is the address of the page, so the link must not follow it.
  event.preventDefault();
  document.getElementById("content")?.focus();
}

function LanguageChoice(): JSX.Element {
  return (
    <label class="bar-choice">
      <span class="visually-hidden">{words.value.choose_language}</span>
      <select
        value={language.value}
        onChange={(event) => {
          if (isLanguage(event.currentTarget.value)) chooseLanguage(event.currentTarget.value);
        }}
      >
        {Object.entries(LANGUAGES).map(([name, texts]) => (
          <option key={name} value={name} lang={name}>
            {texts.language}
          </option>
        ))}
      </select>
    </label>
  );
}

function themeName(name: Theme, say: Words): string {
  return { auto: say.theme_auto, light: say.theme_light, dark: say.theme_dark }[name];
}

function ThemeChoice({ say }: { say: Words }): JSX.Element {
  return (
    <div class="segments" role="group" aria-label={say.theme}>
      {THEMES.map((name) => (
        <button
          key={name}
          type="button"
          aria-pressed={theme.value === name}
          onClick={() => chooseTheme(name)}
        >
          {themeName(name, say)}
        </button>
      ))}
    </div>
  );
}

function Logo(): JSX.Element {
  return (
    <svg width="26" height="26" viewBox="0 0 26 26" aria-hidden="true">
      <path d="M1 1 H13 V13 H1 Z M13 13 H25 V25 H13 Z" fill="#e9eef1" />
      <circle cx="13" cy="13" r="5.6" fill="none" stroke="#e69f00" stroke-width="2.2" />
    </svg>
  );
}

export function OfflineBar(): JSX.Element | null {
  if (online.value) return null;
  return (
    <div class="offline" role="alert">
      <svg width="20" height="20" viewBox="0 0 24 24" aria-hidden="true">
        <path
          d="M3 3 L21 21 M12 19.2 V19.3 M8.5 15.8 A5 5 0 0 1 12 14.4 M5.2 12.2 A9.6 9.6 0 0 1 9 9.9 M13.5 9.6 A9.6 9.6 0 0 1 18.8 12.2"
          fill="none"
          stroke="currentColor"
          stroke-width="2.2"
          stroke-linecap="round"
        />
      </svg>
      <strong>{words.value.offline_title}</strong>
      <span>{words.value.offline_detail}</span>
    </div>
  );
}
