// Says the instruction aloud while the voice is switched on.
import { useEffect } from "preact/hooks";
import { localeOf } from "../format/times";
import { language, words } from "../words/language";
import type { Kiosk } from "./kiosk";
import { NOTHING_PENDING, paceSpeech, Voice } from "./speech";
import { spokenOf } from "./spoken";

const LOOK_MS = 150;

export function useSpeech(kiosk: Kiosk): void {
  const isOn = kiosk.speech.value;
  useEffect(() => {
    if (!isOn) return undefined;
    const voice = new Voice();
    let pending = NOTHING_PENDING;
    const look = (): void => {
      const now_ms = performance.now();
      const text = spokenOf(kiosk.state.value, kiosk.mirrored.value, words.value);
      const paced = paceSpeech(pending, text, now_ms, voice.isSpeaking(now_ms));
      pending = paced.pending;
      if (paced.say !== null) voice.say(paced.say, localeOf(language.value), now_ms);
    };
    const timer = window.setInterval(look, LOOK_MS);
    return () => {
      window.clearInterval(timer);
      voice.hush();
    };
  }, [kiosk, isOn]);
}
