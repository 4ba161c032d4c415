// Worker of a browser source: raw grey pixels of the camera, at half size for guidance, in full when asked for.
// A canvas would be simpler and is not lossless: it stretches 16..235 to 0..255.
import type { FromCamera, ToCamera } from "./camera_messages";
import { pack } from "./framed";
import { halfSize, packRows } from "./half_size";
import { RecentFrames, type FullFrame } from "./recent_frames";

const KEPT_FRAMES = 12;
/** Formats whose first plane is the grey image. */
const GREY_FIRST = /^(I420|I422|I444|NV12)/;

const recent = new RecentFrames(KEPT_FRAMES);
let serial: string | null = null;
let credits = 0;
let sequence = 0;

function tell(message: FromCamera, moved: Transferable[]): void {
  self.postMessage(message, { transfer: moved });
}

self.addEventListener("message", ({ data }: MessageEvent<ToCamera>) => {
  if (data.kind === "start") void follow(data.frames);
  else if (data.kind === "want_full") sendFull(data.sequence);
  else {
    if (data.serial !== serial) recent.forget();
    ({ serial, credits } = data);
  }
});

async function follow(frames: ReadableStream<VideoFrame>): Promise<void> {
  const reader = frames.getReader();
  for (;;) {
    const { done, value: frame } = await reader.read();
    if (done) break;
    if (serial === null || credits <= 0) frame.close();
    else await send(frame, serial);
  }
  tell({ kind: "ended" }, []);
}

async function send(frame: VideoFrame, of: string): Promise<void> {
  credits -= 1;
  sequence += 1;
  const full = await fullFrame(frame, of);
  recent.keep(full);
  const { width, height, grey, at_ms } = full;
  const half = halfSize(grey, width, height);
  const head = { type: "frame", sequence: full.sequence, scale: 2, full: false, at_ms, serial: of } as const;
  const message = pack({ ...head, width: width >> 1, height: height >> 1 }, half);
  tell({ kind: "frame", sequence: full.sequence, message, picture: frame }, [message, frame]);
}

async function fullFrame(frame: VideoFrame, of: string): Promise<FullFrame> {
  const isGreyFirst = frame.format !== null && GREY_FIRST.test(frame.format);
  // Frames of a canvas or a screen come as colours: their green channel stands for grey.
  const options: VideoFrameCopyToOptions = isGreyFirst ? {} : { format: "RGBA" };
  const bytes = new Uint8Array(frame.allocationSize(options));
  const [plane] = await frame.copyTo(bytes, options);
  if (plane === undefined) throw new Error("a camera frame has no plane");
  const { width, height } = frame.visibleRect ?? { width: frame.codedWidth, height: frame.codedHeight };
  const layout = isGreyFirst
    ? { ...plane, step: 1 }
    : { offset: plane.offset + 1, stride: plane.stride, step: 4 };
  const grey = packRows(bytes, layout, width, height);
  return { sequence, width, height, at_ms: performance.now(), serial: of, grey };
}

function sendFull(wanted: number): void {
  const found = recent.find(wanted);
  // A frame that is no longer held is not answered: the service asks for another one.
  if (found === null) return;
  const { grey, ...rest } = found;
  const message = pack({ ...rest, type: "frame", scale: 1, full: true }, grey);
  tell({ kind: "full", message }, [message]);
}
