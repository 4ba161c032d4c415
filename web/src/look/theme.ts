// Light or dark: by the system, or by hand. The colours themselves are in tokens.css.
import { computed, signal } from "@preact/signals";

export const THEMES = ["auto", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

const STORED_AS = "dmscal.theme";
const systemDark = window.matchMedia("(prefers-color-scheme: dark)");
const systemIsDark = signal(systemDark.matches);

function isTheme(name: string | null): name is Theme {
  return THEMES.some((theme) => theme === name);
}

export const theme = signal<Theme>("auto");
/** What is on the screen: drawings on a canvas have to be drawn again when it changes. */
export const dark = computed(() => (theme.value === "auto" ? systemIsDark.value : theme.value === "dark"));

export function showTheme(name: Theme): void {
  theme.value = name;
  if (name === "auto") delete document.documentElement.dataset["theme"];
  else document.documentElement.dataset["theme"] = name;
}

export function showFirstTheme(): void {
  const stored = localStorage.getItem(STORED_AS);
  showTheme(isTheme(stored) ? stored : "auto");
  systemDark.addEventListener("change", (event) => {
    systemIsDark.value = event.matches;
  });
}

export function chooseTheme(name: Theme): void {
  localStorage.setItem(STORED_AS, name);
  showTheme(name);
}
