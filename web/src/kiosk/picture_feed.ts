// Which picture belongs to which state. A picture is shown together with what the service said about it.
import type { State } from "../generated/protocol";

export type Picture = ImageBitmap | VideoFrame;

export interface Shown {
  picture: Picture | null;
  live: State | null;
}

export const NOTHING_SHOWN: Shown = { picture: null, live: null };
export const MOST_UNDERWAY = 2;

/** Frames of the kiosk's own camera that wait for the service's word. */
export class Underway {
  private readonly frames = new Map<number, Picture>();

  add(sequence: number, picture: Picture): void {
    this.frames.set(sequence, picture);
  }

  /** The frame that was judged. Older ones are let go: the newest wins, and who was skipped is never judged. */
  take(sequence: number): Picture | null {
    const judged = this.frames.get(sequence) ?? null;
    for (const [number, frame] of this.frames) {
      if (number > sequence) continue;
      if (number < sequence) frame.close();
      this.frames.delete(number);
    }
    return judged;
  }

  forget(): void {
    for (const frame of this.frames.values()) frame.close();
    this.frames.clear();
  }

  get credits(): number {
    return Math.max(0, MOST_UNDERWAY - this.frames.size);
  }
}
