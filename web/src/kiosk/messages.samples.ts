// Messages as the service sends them, for tests: a run of three poses.
import type {
  CaptureAccepted,
  PoseAngles,
  ProblemTold,
  Run,
  RunVerdict,
  State,
  WantedPose,
  Welcome,
} from "../generated/protocol";

const ANGLES: PoseAngles = { tilt_deg: 0, turn_deg: 0, roll_deg: 0, distance_m: 0.5 };

function pose(pose_index: number): WantedPose {
  const left = 100 + 50 * pose_index;
  const outline: [number, number][] = [
    [left, 100],
    [left + 320, 100],
    [left + 320, 300],
    [left, 300],
  ];
  return { pose_index, outline, angles: ANGLES, added_for: null, replaces: null };
}

export function welcome(more: Partial<Welcome>): Welcome {
  return {
    type: "welcome",
    protocol: 1,
    station: "line1",
    name: "Line 1",
    source: "virtual",
    language: null,
    role: "kiosk",
    run_id: null,
    skus: ["lens1"],
    may_override: false,
    moves_board: false,
    ...more,
  };
}

export function run(more: Partial<Run>): Run {
  return {
    type: "run",
    run_id: "run-1",
    serial: "VIN-1",
    sku: "lens1",
    revision: 1,
    purpose: "simulated",
    image_size: [1280, 800],
    board: { columns: 9, rows: 6, dot_steps: null },
    poses: [pose(0), pose(1), pose(2)],
    captured: [],
    pose_index: 0,
    automatic: true,
    total: 3,
    promised: null,
    accuracy: null,
    estimate: null,
    ...more,
  };
}

export function live(more: Partial<State>): State {
  return {
    type: "state",
    sequence: 1,
    at_ms: 0,
    run_id: "run-1",
    board: "absent",
    seen: null,
    ghost: null,
    difference: null,
    hints: [],
    match: 0,
    dwell: 0,
    pose_index: 0,
    captured: 0,
    total: 3,
    automatic: true,
    is_capturing: false,
    accuracy: null,
    instead_of: null,
    tried_s: 0,
    absent_s: 0,
    camera: null,
    round_trip_ms: null,
    ...more,
  };
}

export function accepted(more: Partial<CaptureAccepted>): CaptureAccepted {
  return {
    type: "capture_accepted",
    pose_index: 0,
    capture_id: "capture-1",
    number: 1,
    captured: [0],
    total: 3,
    match_error_px: 4.2,
    edge_width_px: 1.8,
    accuracy: null,
    estimate: null,
    ...more,
  };
}

export function verdict(more: Partial<RunVerdict>): RunVerdict {
  return {
    type: "verdict",
    run_id: "run-1",
    serial: "VIN-1",
    verdict: "PASS",
    gates: [],
    reasons: [],
    result: "/api/v1/runs/run-1/result",
    ...more,
  };
}

export function problem(more: Partial<ProblemTold>): ProblemTold {
  return { type: "problem", code: "conflict", title: "Title", detail: "What to do.", facts: {}, ...more };
}
