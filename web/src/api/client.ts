// The only place that talks to the service: adds the key, turns every failure into a Problem.
import { reportReached, reportUnreached } from "./connection";
import { dropRefusedKey, key } from "./key";
import { meansUnreachable, mustAskForKey, problemFrom, RequestFailed, UNREACHABLE } from "./problem";
import { partPath, ROOT, runsPath, yieldPath, type RunsQuery } from "./paths";
import type {
  CaptureDetail,
  PagePoseSetSummary,
  PageRunSummary,
  PageSku,
  PageStationStanding,
  PoseSet,
  RevisionLimits,
  RunDetail,
  SkuDetail,
  Station,
  Vehicle,
  Yield,
} from "../generated/api";

interface Change {
  method: "PATCH";
  body: unknown;
}

async function request(path: string, signal?: AbortSignal, change?: Change): Promise<Response> {
  let answer: Response;
  const used = key.value;
  try {
    answer = await fetch(path, {
      headers: {
        Authorization: `Bearer ${used ?? ""}`,
        ...(change && { "Content-Type": "application/json" }),
      },
      ...(change && { method: change.method, body: JSON.stringify(change.body) }),
      ...(signal && { signal }),
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    reportUnreached();
    throw new RequestFailed(UNREACHABLE);
  }
  if (answer.ok) {
    reportReached();
    return answer;
  }
  return refuse(answer, used);
}

async function refuse(answer: Response, used: string | null): Promise<never> {
  const problem = problemFrom(answer.status, await answer.json().catch(() => null));
  if (meansUnreachable(problem)) reportUnreached();
  else reportReached();
  // Of several requests with a refused key the first one tells why; the others may be cut off in mid-answer.
  if (mustAskForKey(problem) && used === key.value) dropRefusedKey(problem.detail);
  throw new RequestFailed(problem);
}

async function getJson<T>(path: string, signal?: AbortSignal): Promise<T> {
  const answer = await request(path, signal);
  return (await answer.json()) as T;
}

export function getRuns(query: RunsQuery, signal?: AbortSignal): Promise<PageRunSummary> {
  return getJson(runsPath(query), signal);
}

export function getRun(id: string, signal?: AbortSignal): Promise<RunDetail> {
  return getJson(`${ROOT}/runs/${encodeURIComponent(id)}`, signal);
}

export function getCapture(id: string, signal?: AbortSignal): Promise<CaptureDetail> {
  return getJson(`${ROOT}/captures/${encodeURIComponent(id)}`, signal);
}

export function getVehicle(serial: string, signal?: AbortSignal): Promise<Vehicle> {
  return getJson(`${ROOT}/vehicles/${encodeURIComponent(serial)}`, signal);
}

export function getStations(cursor: string | null, signal?: AbortSignal): Promise<PageStationStanding> {
  return getJson(partPath("/statistics/stations", cursor), signal);
}

export async function setStationSource(code: string, source: string): Promise<Station> {
  const path = `${ROOT}/stations/${encodeURIComponent(code)}`;
  const answer = await request(path, undefined, { method: "PATCH", body: { source } });
  return (await answer.json()) as Station;
}

export function getSkus(cursor: string | null, signal?: AbortSignal): Promise<PageSku> {
  return getJson(partPath("/skus", cursor), signal);
}

export function getSku(code: string, signal?: AbortSignal): Promise<SkuDetail> {
  return getJson(`${ROOT}/skus/${encodeURIComponent(code)}`, signal);
}

export function getLimits(code: string, revision: number, signal?: AbortSignal): Promise<RevisionLimits> {
  return getJson(`${ROOT}/skus/${encodeURIComponent(code)}/revisions/${revision}/limits`, signal);
}

export function getPoseSets(code: string, signal?: AbortSignal): Promise<PagePoseSetSummary> {
  return getJson(partPath(`/skus/${encodeURIComponent(code)}/pose-sets`, null), signal);
}

export function getPoseSet(id: string, signal?: AbortSignal): Promise<PoseSet> {
  return getJson(`${ROOT}/pose-sets/${encodeURIComponent(id)}`, signal);
}

export function getYield(sku: string, station: string, signal?: AbortSignal): Promise<Yield> {
  return getJson(yieldPath(sku, station), signal);
}

/** Images need the key too, so an <img src> cannot fetch them: they come as blobs. */
export async function getImage(url: string): Promise<Blob> {
  return (await request(url)).blob();
}
