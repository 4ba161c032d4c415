// What the kiosk knows, as one reducer over the server's messages and the fate of its socket. No clock, no screen.
import type {
  CaptureAccepted,
  CaptureRefused,
  ProblemTold,
  Run,
  RunVerdict,
  ServerMessage,
  State,
  Welcome,
} from "../generated/protocol";

export type Connection =
  | { kind: "connecting" }
  | { kind: "open" }
  /** Tried again by itself unless `isFinal`. */
  | { kind: "lost"; code: number; isFinal: boolean };

export type Told = Pick<ProblemTold, "code" | "title" | "detail"> & Partial<Pick<ProblemTold, "facts">>;

export interface KioskState {
  connection: Connection;
  welcome: Welcome | null;
  run: Run | null;
  /** Of the newest judged frame of this run. */
  live: State | null;
  verdict: RunVerdict | null;
  /** Something that went wrong, until it is mended or read. */
  problem: Told | null;
  /** The newest capture that was stored, counted so that each one is noticed once. */
  stored: { count: number; capture: CaptureAccepted | null };
  refused: { count: number; capture: CaptureRefused | null };
}

export type KioskEvent =
  | { kind: "told"; message: ServerMessage }
  | { kind: "lost"; code: number; isFinal: boolean }
  | { kind: "problem"; problem: Told }
  | { kind: "read" }
  | { kind: "refusal-seen"; count: number };

export const FIRST_STATE: KioskState = {
  connection: { kind: "connecting" },
  welcome: null,
  run: null,
  live: null,
  verdict: null,
  problem: null,
  stored: { count: 0, capture: null },
  refused: { count: 0, capture: null },
};

/** Problems of the picture itself: the next picture shows that they are over. */
const MENDED_BY_A_PICTURE = /^(source|frame|camera)-|wrong-image-size/;

export function nextState(state: KioskState, event: KioskEvent): KioskState {
  switch (event.kind) {
    case "told":
      return heard(state, event.message);
    case "lost": {
      const { code, isFinal } = event;
      return { ...state, connection: { kind: "lost", code, isFinal }, live: null };
    }
    case "problem":
      return troubled(state, event.problem);
    case "read":
      return { ...state, problem: null };
    case "refusal-seen":
      // A newer one has its own time.
      if (event.count !== state.refused.count) return state;
      return { ...state, refused: { ...state.refused, capture: null } };
  }
}

function heard(state: KioskState, message: ServerMessage): KioskState {
  switch (message.type) {
    case "welcome":
      return welcomed(state, message);
    case "run":
      return began(state, message);
    case "state":
      return judged(state, message);
    case "capture_accepted":
      return stored(state, message);
    case "capture_refused":
      return { ...state, refused: { count: state.refused.count + 1, capture: message } };
    case "verdict":
      return { ...state, verdict: message, live: null, problem: null };
    case "run_closed":
      return { ...state, run: null, live: null, verdict: null, problem: null };
    case "problem":
      return troubled(state, toldBy(message));
    default:
      // `want_full_frame` is for the camera; a newer service may say what this page does not know.
      return state;
  }
}

function troubled(state: KioskState, problem: Told): KioskState {
  // What an old picture showed guides nobody.
  return { ...state, problem, live: isOfThePicture(problem) ? null : state.live };
}

function isOfThePicture(problem: Told): boolean {
  return MENDED_BY_A_PICTURE.test(problem.code);
}

function toldBy({ code, title, detail, facts }: ProblemTold): Told {
  return { code, title, detail, facts };
}

function welcomed(state: KioskState, welcome: Welcome): KioskState {
  const open: KioskState = { ...state, connection: { kind: "open" }, welcome, problem: null };
  // A verdict stays until somebody asks for the next vehicle; a run that the service no longer has does not.
  if (welcome.run_id !== null || state.verdict !== null) return open;
  return { ...open, run: null, live: null };
}

function began(state: KioskState, run: Run): KioskState {
  const isSame = state.run?.run_id === run.run_id;
  return {
    ...state,
    run,
    live: isSame && state.live?.pose_index === run.pose_index ? state.live : null,
    verdict: isSame ? state.verdict : null,
    problem: null,
    refused: { ...state.refused, capture: null },
  };
}

function judged(state: KioskState, live: State): KioskState {
  // A picture that was still being decoded when the socket was lost guides nobody.
  const isHeard = state.connection.kind === "open" && state.verdict === null;
  if (!isHeard || live.run_id !== state.run?.run_id) return state;
  const isMended = state.problem !== null && isOfThePicture(state.problem);
  const run = { ...state.run, pose_index: live.pose_index, automatic: live.automatic };
  const isKnown = run.pose_index === state.run.pose_index && run.automatic === state.run.automatic;
  return { ...state, run: isKnown ? state.run : run, live, problem: isMended ? null : state.problem };
}

function stored(state: KioskState, capture: CaptureAccepted): KioskState {
  if (state.run === null) return state;
  return {
    ...state,
    run: {
      ...state.run,
      captured: capture.captured,
      total: capture.total,
      accuracy: capture.accuracy,
      estimate: capture.estimate,
    },
    stored: { count: state.stored.count + 1, capture },
    refused: { ...state.refused, capture: null },
    problem: null,
  };
}

export type Screen = "connecting" | "closed" | "start" | "guide" | "verdict";

/** A verdict is on show only when the service said it, and it says it only once the result is stored. */
export function screenOf(state: KioskState): Screen {
  const { connection } = state;
  if (connection.kind === "lost" && (connection.isFinal || state.welcome === null)) return "closed";
  if (state.welcome === null) return "connecting";
  if (state.run === null) return state.verdict === null ? "start" : "verdict";
  return state.verdict === null ? "guide" : "verdict";
}

export function isOnline(state: KioskState): boolean {
  return state.connection.kind === "open";
}

/** Whether the picture that is shown is one of now. */
export function isLive(state: KioskState): boolean {
  return isOnline(state) && (state.problem === null || !isOfThePicture(state.problem));
}

/** No pose is asked for any more and the service is computing. */
export function isFinishing({ run }: KioskState): boolean {
  return run !== null && run.pose_index === null;
}
