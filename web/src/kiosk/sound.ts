// Short tones for what eyes may miss: up when a capture is stored, down when it is refused.

type Tone = [hertz: number, from_s: number, lasts_s: number];

const TONES = {
  stored: [
    [740, 0, 0.09],
    [1110, 0.09, 0.14],
  ],
  refused: [
    [440, 0, 0.14],
    [290, 0.14, 0.24],
  ],
  passed: [
    [660, 0, 0.12],
    [880, 0.12, 0.12],
    [1320, 0.24, 0.3],
  ],
  failed: [
    [392, 0, 0.22],
    [311, 0.22, 0.22],
    [233, 0.44, 0.5],
  ],
  scanned: [[990, 0, 0.06]],
} as const satisfies Record<string, readonly Tone[]>;

export type SoundName = keyof typeof TONES;

const VOLUME = 0.16;
const STORED_AS = "dmscal.kiosk.sound";

export function isSoundOn(): boolean {
  return localStorage.getItem(STORED_AS) !== "off";
}

export function rememberSound(isOn: boolean): void {
  localStorage.setItem(STORED_AS, isOn ? "on" : "off");
}

export class Sounds {
  private context: AudioContext | null = null;

  /** Browsers let a page sound only after a key or a tap: call it in one. */
  wake(): void {
    this.context ??= new AudioContext();
    if (this.context.state === "suspended") void this.context.resume();
  }

  play(name: SoundName): void {
    const { context } = this;
    if (context?.state !== "running") return;
    for (const [hertz, from_s, lasts_s] of TONES[name]) {
      const tone = new OscillatorNode(context, { type: "triangle", frequency: hertz });
      const start = context.currentTime + from_s;
      const gain = new GainNode(context, { gain: 0 });
      gain.gain.linearRampToValueAtTime(VOLUME, start + 0.01);
      gain.gain.setValueAtTime(VOLUME, start + lasts_s - 0.03);
      gain.gain.linearRampToValueAtTime(0, start + lasts_s);
      tone.connect(gain).connect(context.destination);
      tone.start(start);
      tone.stop(start + lasts_s);
    }
  }
}
