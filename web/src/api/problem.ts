// Everything that can go wrong with a request, as one shape the pages can show: a title and what to do.
import type { Problem as ProblemDocument } from "../generated/api";

export interface Problem {
  /** HTTP status; 0 when the service was not reached at all. */
  status: number;
  code: string;
  title: string;
  detail: string;
  /** Validation errors: where in the request, and what is wrong there. */
  errors: { pointer: string; detail: string }[];
  traceId: string | null;
}

export class RequestFailed extends Error {
  readonly problem: Problem;

  constructor(problem: Problem) {
    super(problem.title);
    this.name = "RequestFailed";
    this.problem = problem;
  }
}

export const UNREACHABLE: Problem = {
  status: 0,
  code: "unreachable",
  title: "",
  detail: "",
  errors: [],
  traceId: null,
};

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function text(value: unknown, otherwise: string): string {
  return typeof value === "string" && value !== "" ? value : otherwise;
}

function readErrors(value: unknown): Problem["errors"] {
  if (!Array.isArray(value)) return [];
  return value
    .filter(isRecord)
    .map((error) => ({ pointer: text(error["pointer"], ""), detail: text(error["detail"], "") }));
}

/** A problem out of any answer: a proxy between page and service may answer with something else than ours. */
export function problemFrom(status: number, body: unknown): Problem {
  const document: Partial<Record<keyof ProblemDocument, unknown>> = isRecord(body) ? body : {};
  return {
    status,
    code: text(document.code, `http-${status}`),
    title: text(document.title, `HTTP ${status}`),
    detail: text(document.detail, ""),
    errors: readErrors(document.errors),
    traceId: text(document.trace_id, "") || null,
  };
}

/** Gateways answer these when the service behind them is down: to a user that is "no server". */
export function meansUnreachable(problem: Problem): boolean {
  return [0, 502, 503, 504].includes(problem.status);
}

export function mustAskForKey(problem: Problem): boolean {
  return problem.status === 401;
}
