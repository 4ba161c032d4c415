// When an instruction is said aloud, and by whom. Once it has stood for a moment and the voice is free; each one once,
// and never one over another. Not here: what is said (spoken).

/** An instruction that stands for less was on its way to another one. */
const STOOD_MS = 600;
/** A voice that speaks longer hangs: some platforms never say that it ended. */
const HANGS_MS = 10_000;

export interface Pending {
  text: string | null;
  since_ms: number;
  /** The last one that was said. */
  said: string | null;
}

export const NOTHING_PENDING: Pending = { text: null, since_ms: 0, said: null };

/** One look at what the screen says; `say` is what is to be said now. */
export function paceSpeech(
  before: Pending,
  text: string | null,
  at_ms: number,
  isSpeaking: boolean,
): { pending: Pending; say: string | null } {
  if (text !== before.text) return { pending: { ...before, text, since_ms: at_ms }, say: null };
  const isDue = text !== null && text !== before.said && at_ms - before.since_ms >= STOOD_MS;
  if (!isDue || isSpeaking) return { pending: before, say: null };
  return { pending: { ...before, said: text }, say: text };
}

const STORED_AS = "dmscal.kiosk.speech";

export function isSpeechOn(): boolean {
  return canSpeak() && localStorage.getItem(STORED_AS) === "on";
}

export function rememberSpeech(isOn: boolean): void {
  localStorage.setItem(STORED_AS, isOn ? "on" : "off");
}

/** Not every browser has a voice, whatever its types say. */
export function canSpeak(): boolean {
  return "speechSynthesis" in window && "SpeechSynthesisUtterance" in window;
}

export class Voice {
  private since_ms = 0;

  isSpeaking(at_ms: number): boolean {
    const { speaking, pending } = window.speechSynthesis;
    if (!speaking && !pending) return false;
    if (at_ms - this.since_ms < HANGS_MS) return true;
    this.hush();
    return false;
  }

  /** `tag`: the language and country, such as de-DE. */
  say(text: string, tag: string, at_ms: number): void {
    const utterance = new SpeechSynthesisUtterance(text);
    utterance.lang = tag;
    // Where the platform's own voice speaks another language, it would read the words as nobody understands them.
    utterance.voice =
      window.speechSynthesis.getVoices().find((voice) => voice.lang.slice(0, 2) === tag.slice(0, 2)) ?? null;
    this.since_ms = at_ms;
    window.speechSynthesis.speak(utterance);
  }

  hush(): void {
    window.speechSynthesis.cancel();
  }
}
