// Switches of the station: mirror, sound, voice, language, brightness, full screen.
import { type JSX } from "preact";
import { chooseTheme, dark } from "../look/theme";
import { chooseLanguage, language, LANGUAGES, nextLanguage, tagOf, words } from "../words/language";
import { hasFullScreen, isFullScreen, toggleFullScreen } from "./full_screen";
import type { Kiosk } from "./kiosk";
import { canSpeak } from "./speech";

interface Props {
  kiosk: Kiosk;
  /** Also what nobody needs during a run. */
  isWhole?: boolean;
}

export function Switches({ kiosk, isWhole = false }: Props): JSX.Element {
  const say = words.value;
  const isMirrored = kiosk.mirrored.value;
  const hasSound = kiosk.sound.value;
  return (
    <div class="switches">
      <button
        type="button"
        class="switch"
        aria-pressed={isMirrored}
        onClick={() => kiosk.setMirrored(!isMirrored)}
      >
        <Icon path="M12 3 V21 M9 7 L3 17 H9 Z M15 7 L21 17 H15 Z" />
        {say.act_mirror}
      </button>
      <button type="button" class="switch" aria-pressed={hasSound} onClick={() => kiosk.setSound(!hasSound)}>
        <Icon
          path={
            hasSound
              ? "M4 9 V15 H8 L13 19 V5 L8 9 Z M16 9 A4.5 4.5 0 0 1 16 15 M18.5 6 A9 9 0 0 1 18.5 18"
              : "M4 9 V15 H8 L13 19 V5 L8 9 Z M16 9.5 L21 14.5 M21 9.5 L16 14.5"
          }
        />
        {say.act_sound}
      </button>
      <VoiceSwitch kiosk={kiosk} />
      <LanguageAndLight />
      {isWhole && <FullScreenSwitch />}
    </div>
  );
}

function VoiceSwitch({ kiosk }: { kiosk: Kiosk }): JSX.Element | null {
  const isOn = kiosk.speech.value;
  if (!canSpeak()) return null;
  return (
    <button type="button" class="switch" aria-pressed={isOn} onClick={() => kiosk.setSpeech(!isOn)}>
      <Icon path="M4 5 H20 V16 H12 L7 20 V16 H4 Z M8 9 H16 M8 12.5 H13" />
      {words.value.act_speech}
    </button>
  );
}

function FullScreenSwitch(): JSX.Element | null {
  if (!hasFullScreen) return null;
  return (
    <button type="button" class="switch" aria-pressed={isFullScreen.value} onClick={toggleFullScreen}>
      <Icon path="M4 9 V4 H9 M15 4 H20 V9 M20 15 V20 H15 M9 20 H4 V15" />
      {words.value.act_full_screen}
    </button>
  );
}

export function LanguageAndLight(): JSX.Element {
  const say = words.value;
  const other = nextLanguage(language.value);
  const isDark = dark.value;
  return (
    <>
      <button type="button" class="switch" lang={tagOf(other)} onClick={() => chooseLanguage(other)}>
        <Icon path="M3 12 A9 9 0 1 0 21 12 A9 9 0 1 0 3 12 M3 12 H21 M12 3 A14 14 0 0 1 12 21 A14 14 0 0 1 12 3" />
        {LANGUAGES[other].language}
      </button>
      <button
        type="button"
        class="switch switch-light"
        onClick={() => chooseTheme(isDark ? "light" : "dark")}
      >
        <Icon path="M12 3 A9 9 0 1 0 12 21 A9 9 0 1 0 12 3 M12 3 A9 9 0 0 1 12 21 M12 7 H17.6 M12 12 H20.5 M12 17 H17.6" />
        {isDark ? say.theme_light : say.theme_dark}
      </button>
    </>
  );
}

function Icon({ path }: { path: string }): JSX.Element {
  return (
    <svg class="switch-icon" viewBox="0 0 24 24" aria-hidden="true">
      <path d={path} />
    </svg>
  );
}
