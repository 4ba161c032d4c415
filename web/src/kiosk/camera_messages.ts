// What the page and its camera worker tell each other.

export type ToCamera =
  | { kind: "start"; frames: ReadableStream<VideoFrame> }
  /** Whose frames they are, and how many may be on their way to the service; null: none are wanted. */
  | { kind: "send"; serial: string | null; credits: number }
  | { kind: "want_full"; sequence: number };

export type FromCamera =
  /** `message` is ready for the socket; `picture` is to be drawn when its state comes, and to be closed. */
  | { kind: "frame"; sequence: number; message: ArrayBuffer; picture: VideoFrame }
  | { kind: "full"; message: ArrayBuffer }
  | { kind: "ended" };
