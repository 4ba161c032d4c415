// The kiosk's own camera: opened at the size that the run asks for, its frames handled by a worker.
import type { FromCamera, ToCamera } from "./camera_messages";

export type CameraFailure = "denied" | "missing" | "busy" | "unsupported" | "ended";

export interface CameraListener {
  frame: (frame: Extract<FromCamera, { kind: "frame" }>) => void;
  full: (message: ArrayBuffer) => void;
  failed: (why: CameraFailure) => void;
}

interface TrackProcessor {
  readonly readable: ReadableStream<VideoFrame>;
}

declare global {
  interface Window {
    MediaStreamTrackProcessor?: new (init: { track: MediaStreamTrack }) => TrackProcessor;
  }
}

const FAILURES: Readonly<Record<string, CameraFailure>> = {
  NotAllowedError: "denied",
  SecurityError: "denied",
  NotFoundError: "missing",
  OverconstrainedError: "missing",
  NotReadableError: "busy",
  AbortError: "busy",
};

export class Camera {
  private worker: Worker | null = null;
  private stream: MediaStream | null = null;

  constructor(private readonly listener: CameraListener) {}

  get isOpen(): boolean {
    return this.worker !== null;
  }

  async open([width, height]: [number, number]): Promise<void> {
    const Processor = window.MediaStreamTrackProcessor;
    // Without a secure context there is no `mediaDevices`, whatever its type says.
    const devices = navigator.mediaDevices as MediaDevices | undefined;
    if (Processor === undefined || devices === undefined) {
      this.listener.failed("unsupported");
      return;
    }
    try {
      // Pixels as the sensor gives them: the browser must not scale them to the size that is asked for.
      const wanted = { width: { ideal: width }, height: { ideal: height }, frameRate: { ideal: 30 } };
      const video: MediaTrackConstraints & { resizeMode: string } = { ...wanted, resizeMode: "none" };
      this.stream = await devices.getUserMedia({ video, audio: false });
    } catch (error) {
      if (!(error instanceof DOMException)) throw error;
      this.listener.failed(FAILURES[error.name] ?? "busy");
      return;
    }
    const [track] = this.stream.getVideoTracks();
    if (track === undefined) this.listener.failed("missing");
    else this.follow(new Processor({ track }).readable);
  }

  send(serial: string | null, credits: number): void {
    this.post({ kind: "send", serial, credits });
  }

  wantFull(sequence: number): void {
    this.post({ kind: "want_full", sequence });
  }

  close(): void {
    this.worker?.terminate();
    this.worker = null;
    for (const track of this.stream?.getTracks() ?? []) track.stop();
    this.stream = null;
  }

  private follow(frames: ReadableStream<VideoFrame>): void {
    this.worker = new Worker(new URL("./camera_worker.ts", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }: MessageEvent<FromCamera>) => this.hear(data);
    this.post({ kind: "start", frames }, [frames]);
  }

  private hear(data: FromCamera): void {
    if (data.kind === "frame") this.listener.frame(data);
    else if (data.kind === "full") this.listener.full(data.message);
    else {
      this.close();
      this.listener.failed("ended");
    }
  }

  private post(message: ToCamera, moved: Transferable[] = []): void {
    this.worker?.postMessage(message, moved);
  }
}
