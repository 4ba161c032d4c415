// The last full frames of the camera: the service asks for the very one that it judged.

export interface FullFrame {
  sequence: number;
  width: number;
  height: number;
  at_ms: number;
  serial: string;
  grey: Uint8Array<ArrayBuffer>;
}

export class RecentFrames {
  private frames: FullFrame[] = [];

  constructor(private readonly most: number) {}

  keep(frame: FullFrame): void {
    this.frames = [...this.frames.slice(-(this.most - 1)), frame];
  }

  find(sequence: number): FullFrame | null {
    return this.frames.find((frame) => frame.sequence === sequence) ?? null;
  }

  forget(): void {
    this.frames = [];
  }
}
