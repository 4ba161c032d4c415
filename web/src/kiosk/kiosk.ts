// The kiosk itself: joins socket, camera, sounds and state. Screens read its signals and call its verbs.
import { signal } from "@preact/signals";
import type { ClientMessage, Purpose, Run, ServerMessage, State, Welcome } from "../generated/protocol";
import { Camera } from "./camera";
import { unpack } from "./framed";
import { bounded, joined, NO_MOVE, unmirrored, type Move } from "./hand_moves";
import { FIRST_STATE, isLive, nextState, screenOf, type KioskEvent } from "./kiosk_state";
import { isMirrored, rememberMirrored } from "./mirror";
import { speakAt } from "../words/language";
import { Pace } from "./pace";
import { MOST_UNDERWAY, NOTHING_SHOWN, Underway, type Picture, type Shown } from "./picture_feed";
import { practiceSerial, type Practice } from "./practice";
import { GuidanceSocket, socketAddress } from "./socket";
import { isSoundOn, rememberSound, Sounds, type SoundName } from "./sound";
import { isSpeechOn, rememberSpeech } from "./speech";
import { chosenSku, rememberSku } from "./sku_choice";

const PROTOCOL = 1;
const REFUSAL_SHOWN_MS = 4500;
const WATCH_MS = 2000;
const SILENT_MS = 6000;
const UNANSWERED_MS = 2500;
const PROBE_MS = 3000;

export type Question = { kind: "abort" } | { kind: "retake"; pose_index: number };

export class Kiosk {
  readonly state = signal(FIRST_STATE);
  readonly shown = signal<Shown>(NOTHING_SHOWN);
  readonly question = signal<Question | null>(null);
  readonly mirrored;
  readonly sound = signal(isSoundOn());
  readonly speech = signal(isSpeechOn());
  readonly sku = signal<string | null>(null);
  /** Whether a practice is prepared: what is scanned next is a badge. */
  readonly isPractising = signal(false);
  /** Of whoever practises; it leaves this page only for the browser's own memory. */
  readonly badge = signal("");
  readonly practice = signal<Practice | null>(null);
  /** Nobody is there. */
  readonly isIdle = signal(false);
  /** Whether an engineer wants to see how fast pictures come. */
  readonly figures = signal(false);
  readonly pace = new Pace();

  private readonly socket: GuidanceSocket;
  private readonly sounds = new Sounds();
  private readonly underway = new Underway();
  private readonly camera = new Camera({
    frame: ({ sequence, message, picture }) => {
      this.underway.add(sequence, picture);
      this.pace.send(sequence, performance.now());
      this.socket.sendPicture(message);
    },
    full: (message) => this.socket.sendPicture(message),
    failed: (why) => this.tell({ code: `camera-${why}`, title: "", detail: "" }),
  });
  private move: Move | null = null;
  private decoding = Promise.resolve();
  private heardAt = 0;
  private judgedAt = 0;
  private watch: number | undefined;

  constructor(
    readonly station: string,
    key: string,
  ) {
    this.mirrored = signal(isMirrored(station));
    const hello = { type: "hello", key, protocol: PROTOCOL, role: "kiosk" } as const;
    this.socket = new GuidanceSocket(socketAddress(window.location.origin, station), hello, {
      opened: () => this.underway.forget(),
      told: (message) => this.hear(message),
      pictured: (message) => this.see(message),
      closed: (code, again_ms) => this.lose(code, again_ms === null),
    });
  }

  start(): void {
    this.socket.connect();
    this.watch = window.setInterval(() => this.look(), WATCH_MS);
  }

  stop(): void {
    window.clearInterval(this.watch);
    this.socket.close();
    this.camera.close();
    this.underway.forget();
    this.show(null, null);
  }

  retry(): void {
    this.socket.renew();
  }

  /** A serial that was scanned or typed. */
  begin(serial: string): void {
    if (this.isPractising.value) this.practise(serial);
    else this.open(serial, null);
  }

  /** A run that counts for nobody, under a serial that no vehicle has; whose it is, the service never hears. */
  practise(badge: string): void {
    this.badge.value = badge;
    this.open(practiceSerial(new Date()), "trial");
  }

  private open(serial: string, purpose: Purpose | null): void {
    const { run, verdict, welcome } = this.state.value;
    if (run !== null && verdict === null) {
      if (run.serial !== serial) this.refuseScan(run.serial);
      return;
    }
    const sku = this.sku.value;
    if (sku === null && (welcome?.skus.length ?? 0) > 1) {
      this.chime("refused");
      this.tell({ code: "choose-sku", title: "", detail: "" });
      return;
    }
    this.chime("scanned");
    if (verdict !== null) this.say({ type: "next_vehicle" });
    this.say({ type: "open_run", serial, sku, purpose });
  }

  capture(): void {
    this.say({ type: "capture" });
  }

  /** Takes the picture that the checks refuse; recorded, and for engineers only. */
  captureAnyway(): void {
    this.say({ type: "capture", override: true });
  }

  undo(): void {
    this.say({ type: "undo" });
  }

  retake(pose_index: number): void {
    this.say({ type: "retake", pose_index });
  }

  abort(): void {
    this.say({ type: "abort" });
  }

  nextVehicle(): void {
    this.say({ type: "next_vehicle" });
  }

  setAutomatic(automatic: boolean): void {
    this.say({ type: "set_automatic", automatic });
  }

  /** Moves the virtual board, as the display shows it; what comes between two drawings is said at once. */
  moveBoard(move: Partial<Move>): void {
    if (this.move === null) requestAnimationFrame(() => this.sayMove());
    this.move = joined(this.move ?? NO_MOVE, unmirrored(move, this.mirrored.value));
  }

  setMirrored(mirrored: boolean): void {
    rememberMirrored(this.station, mirrored);
    this.mirrored.value = mirrored;
  }

  setSound(isOn: boolean): void {
    rememberSound(isOn);
    this.sound.value = isOn;
    if (isOn) this.chime("stored");
  }

  setSpeech(isOn: boolean): void {
    rememberSpeech(isOn);
    this.speech.value = isOn;
  }

  setSku(code: string): void {
    rememberSku(this.station, code);
    this.readProblem();
    this.sku.value = code;
  }

  wakeSound(): void {
    this.sounds.wake();
  }

  readProblem(): void {
    this.happen({ kind: "read" });
  }

  private say(message: ClientMessage): void {
    this.socket.say(message);
  }

  private sayMove(): void {
    if (this.move !== null) this.say({ type: "move_board", ...bounded(this.move) });
    this.move = null;
  }

  private refuseScan(open: string): void {
    this.chime("refused");
    this.tell({ code: "run-open-here", title: "", detail: open });
  }

  private tell(problem: { code: string; title: string; detail: string }): void {
    this.happen({ kind: "problem", problem });
  }

  private happen(event: KioskEvent): void {
    this.state.value = nextState(this.state.value, event);
    if (screenOf(this.state.value) !== "guide") this.question.value = null;
    if (!isLive(this.state.value)) this.dropGuidance();
  }

  private hear(message: ServerMessage): void {
    this.heardAt = performance.now();
    if (message.type === "want_full_frame") this.camera.wantFull(message.sequence);
    if (message.type === "state") this.judge(this.underway.take(message.sequence), message);
    else this.happen({ kind: "told", message });
    if (message.type === "welcome") this.greet(message);
    if (message.type === "run") {
      this.isPractising.value = false;
      this.useCamera(message);
    }
    if (message.type === "run_closed") this.restCamera();
    if (message.type === "capture_accepted") this.chime("stored");
    if (message.type === "capture_refused") this.forgetRefusal();
    if (message.type === "problem") this.chime("refused");
    if (message.type === "verdict") {
      this.restCamera();
      this.chime(message.verdict === "FAIL" ? "failed" : "passed");
    }
  }

  private greet(welcome: Welcome): void {
    this.sku.value = chosenSku(this.station, welcome.skus);
    speakAt(welcome.language);
  }

  /** A picture of a server-side source, with its state: decoded in order, drawn together, then acknowledged. */
  private see(message: ArrayBuffer): void {
    this.heardAt = performance.now();
    const framed = unpack(message);
    if (framed === null) return;
    const live = framed.head as State;
    this.decoding = this.decoding.then(async () => {
      const picture = await decode(framed.picture);
      this.judge(picture, live);
      this.say({ type: "ack", sequence: live.sequence });
    });
  }

  private judge(picture: Picture | null, live: State): void {
    this.judgedAt = performance.now();
    this.pace.judge(live.sequence, this.judgedAt);
    this.happen({ kind: "told", message: { ...live, type: "state" } });
    const isOurs = this.state.value.live?.sequence === live.sequence;
    if (isOurs) this.show(picture, live);
    else picture?.close();
    this.grant();
  }

  private show(picture: Picture | null, live: State | null): void {
    const before = this.shown.value.picture;
    this.shown.value = { picture: picture ?? (live === null ? null : before), live };
    if (before !== null && this.shown.value.picture !== before) before.close();
  }

  private lose(code: number, isFinal: boolean): void {
    this.happen({ kind: "lost", code, isFinal });
    this.underway.forget();
    this.pace.forget();
    this.camera.send(null, 0);
    this.decoding = Promise.resolve();
  }

  /** The last picture stays, without guidance: nobody says any more whether it is right. */
  private dropGuidance(): void {
    if (this.shown.value.live !== null) this.shown.value = { ...this.shown.value, live: null };
  }

  private useCamera(run: Run): void {
    if (this.state.value.welcome?.source !== "browser") return;
    this.judgedAt = performance.now();
    if (this.camera.isOpen) this.grant();
    else void this.camera.open(run.image_size).then(() => this.grant());
  }

  private restCamera(): void {
    this.camera.send(null, 0);
    this.underway.forget();
    this.show(null, null);
  }

  /** Lets the worker send so many frames as may be under way. */
  private grant(): void {
    const { run, verdict } = this.state.value;
    if (run !== null && verdict === null) this.camera.send(run.serial, this.underway.credits);
  }

  private forgetRefusal(): void {
    this.chime("refused");
    const { count } = this.state.value.refused;
    window.setTimeout(() => this.happen({ kind: "refusal-seen", count }), REFUSAL_SHOWN_MS);
  }

  private chime(name: SoundName): void {
    if (this.sound.value) this.sounds.play(name);
  }

  /** Frames and connections that nobody answers any more. */
  private look(): void {
    const { run, verdict } = this.state.value;
    if (run === null || verdict !== null || !this.socket.isOpen()) return;
    const now = performance.now();
    if (this.underway.credits < MOST_UNDERWAY && now - this.judgedAt > UNANSWERED_MS) {
      this.underway.forget();
      this.grant();
    }
    if (now - this.heardAt > SILENT_MS) void this.probe();
  }

  /** A connection can die without a word; then the service is asked another way. */
  private async probe(): Promise<void> {
    try {
      await fetch("/livez", { cache: "no-store", signal: AbortSignal.timeout(PROBE_MS) });
    } catch {
      if (this.socket.isOpen()) this.socket.renew();
    }
  }
}

/** Null when the bytes are no picture; the state is worth showing without one. */
async function decode(jpeg: Uint8Array<ArrayBuffer>): Promise<ImageBitmap | null> {
  try {
    return await createImageBitmap(new Blob([jpeg], { type: "image/jpeg" }));
  } catch {
    return null;
  }
}
