// The only place that talks to the service: adds the key, turns every failure into a Problem.
import { reportReached, reportUnreached } from "./connection";
import { dropRefusedKey, key } from "./key";
import { meansUnreachable, mustAskForKey, problemFrom, RequestFailed, UNREACHABLE } from "./problem";
import { fileNameOf } from "./file_name";
import { partPath, ROOT, runsPath, yieldPath, type RunsQuery } from "./paths";
import type {
  BoardShape,
  BoardShapeDetail,
  CaptureDetail,
  ExportFormats,
  FixtureDocument,
  Job,
  Language,
  OwnKey,
  PageBoardShape,
  PageLaterExtrinsics,
  PagePoseSetSummary,
  PageRunSummary,
  PageSku,
  PageStationStanding,
  PageTarget,
  Population,
  PoseSet,
  PoseSetRequested,
  PoseSetReview,
  ResultMaps,
  RevisionLimits,
  RunComparison,
  RunDetail,
  SharedPicture,
  SkuDetail,
  Station,
  TargetDetail,
  TargetPattern,
  Vehicle,
  VehicleHistory,
  Yield,
} from "../generated/api";

interface Sent {
  method: "POST" | "PATCH";
  /** What is sent as JSON. */
  body?: unknown;
}

async function request(path: string, signal?: AbortSignal, sent?: Sent): Promise<Response> {
  let answer: Response;
  const used = key.value;
  try {
    answer = await fetch(path, {
      headers: {
        Authorization: `Bearer ${used ?? ""}`,
        ...(sent?.body !== undefined && { "Content-Type": "application/json" }),
      },
      ...(sent && { method: sent.method }),
      ...(sent?.body !== undefined && { body: JSON.stringify(sent.body) }),
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

async function postJson<T>(path: string, body?: unknown): Promise<T> {
  const answer = await request(path, undefined, { method: "POST", body });
  return (await answer.json()) as T;
}

export function getRuns(query: RunsQuery, signal?: AbortSignal): Promise<PageRunSummary> {
  return getJson(runsPath(query), signal);
}

export function getRun(id: string, signal?: AbortSignal): Promise<RunDetail> {
  return getJson(`${ROOT}/runs/${encodeURIComponent(id)}`, signal);
}

export function getResultMaps(id: string, signal?: AbortSignal): Promise<ResultMaps> {
  return getJson(`${ROOT}/runs/${encodeURIComponent(id)}/result/maps`, signal);
}

/** What was measured of a run's camera after the run. */
export function getLaterExtrinsics(
  id: string,
  cursor: string | null,
  signal?: AbortSignal,
): Promise<PageLaterExtrinsics> {
  return getJson(partPath(`/runs/${encodeURIComponent(id)}/extrinsics`, cursor), signal);
}

export function getComparison(a: string, b: string, signal?: AbortSignal): Promise<RunComparison> {
  return getJson(`${ROOT}/runs/${encodeURIComponent(a)}/comparison/${encodeURIComponent(b)}`, signal);
}

export function getSharedPictures(id: string, signal?: AbortSignal): Promise<SharedPicture[]> {
  return getJson(`${ROOT}/runs/${encodeURIComponent(id)}/shared-pictures`, signal);
}

export function getCapture(id: string, signal?: AbortSignal): Promise<CaptureDetail> {
  return getJson(`${ROOT}/captures/${encodeURIComponent(id)}`, signal);
}

export function getVehicle(serial: string, signal?: AbortSignal): Promise<Vehicle> {
  return getJson(`${ROOT}/vehicles/${encodeURIComponent(serial)}`, signal);
}

export function getHistory(serial: string, signal?: AbortSignal): Promise<VehicleHistory> {
  return getJson(`${ROOT}/vehicles/${encodeURIComponent(serial)}/calibrations`, signal);
}

export function getStations(cursor: string | null, signal?: AbortSignal): Promise<PageStationStanding> {
  return getJson(partPath("/statistics/stations", cursor), signal);
}

export async function setStationSource(code: string, source: string): Promise<Station> {
  return changeStation(code, { source });
}

export async function setStationLanguage(code: string, language: Language | null): Promise<Station> {
  return changeStation(code, { language });
}

/** Null takes the fixture away. */
export async function setStationFixture(code: string, fixture: FixtureDocument | null): Promise<Station> {
  return changeStation(code, { fixture });
}

async function changeStation(
  code: string,
  body: { source: string } | { language: Language | null } | { fixture: FixtureDocument | null },
): Promise<Station> {
  const path = `${ROOT}/stations/${encodeURIComponent(code)}`;
  const answer = await request(path, undefined, { method: "PATCH", body });
  return (await answer.json()) as Station;
}

/** The key of this tab itself. */
export function getOwnKey(): Promise<OwnKey> {
  return getJson(`${ROOT}/keys/own`);
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

export function getPopulation(code: string, revision: number, signal?: AbortSignal): Promise<Population> {
  return getJson(`${ROOT}/skus/${encodeURIComponent(code)}/population?revision=${revision}`, signal);
}

export function getPoseSets(
  code: string,
  cursor: string | null,
  signal?: AbortSignal,
): Promise<PagePoseSetSummary> {
  return getJson(partPath(`/skus/${encodeURIComponent(code)}/pose-sets`, cursor), signal);
}

export function getPoseSet(id: string, signal?: AbortSignal): Promise<PoseSet> {
  return getJson(`${ROOT}/pose-sets/${encodeURIComponent(id)}`, signal);
}

export function getReview(id: string, signal?: AbortSignal): Promise<PoseSetReview> {
  return getJson(`${ROOT}/pose-sets/${encodeURIComponent(id)}/review`, signal);
}

export function publishPoseSet(id: string): Promise<PoseSet> {
  return postJson(`${ROOT}/pose-sets/${encodeURIComponent(id)}/publish`);
}

export function retirePoseSet(id: string): Promise<PoseSet> {
  return postJson(`${ROOT}/pose-sets/${encodeURIComponent(id)}/retire`);
}

/** A file, and the name that the service gives it. */
export interface NamedFile {
  name: string;
  content: Blob;
}

async function getFile(path: string): Promise<NamedFile> {
  const answer = await request(path);
  const name = fileNameOf(answer.headers.get("Content-Disposition") ?? "");
  return { name: name ?? "dmscal", content: await answer.blob() };
}

export function exportPoseSet(id: string): Promise<NamedFile> {
  return getFile(`${ROOT}/pose-sets/${encodeURIComponent(id)}/export`);
}

export function getCertificate(runId: string): Promise<NamedFile> {
  return getFile(`${ROOT}/runs/${encodeURIComponent(runId)}/certificate`);
}

export function getExtrinsicsCertificate(id: string): Promise<NamedFile> {
  return getFile(`${ROOT}/extrinsics/${encodeURIComponent(id)}/certificate`);
}

export function getExportFormats(signal?: AbortSignal): Promise<ExportFormats> {
  return getJson(`${ROOT}/exports`, signal);
}

export function getExportedResult(runId: string, format: string, allowFailed: boolean): Promise<NamedFile> {
  const path = `${ROOT}/runs/${encodeURIComponent(runId)}/exports/${encodeURIComponent(format)}`;
  return getFile(allowFailed ? `${path}?allow_failed=true` : path);
}

export function importPoseSet(code: string, revision: number, document: unknown): Promise<PoseSetRequested> {
  return postJson(`${ROOT}/skus/${encodeURIComponent(code)}/revisions/${revision}/pose-sets`, document);
}

export function getTargets(cursor: string | null, signal?: AbortSignal): Promise<PageTarget> {
  return getJson(partPath("/targets", cursor), signal);
}

/** `board`: its serial or id. */
export function getBoard(board: string, signal?: AbortSignal): Promise<TargetDetail> {
  return getJson(`${ROOT}/targets/${encodeURIComponent(board)}`, signal);
}

export function getShapes(
  board: string,
  cursor: string | null,
  signal?: AbortSignal,
): Promise<PageBoardShape> {
  return getJson(partPath(`/targets/${encodeURIComponent(board)}/shapes`, cursor), signal);
}

export function getShape(id: string, signal?: AbortSignal): Promise<BoardShapeDetail> {
  return getJson(`${ROOT}/board-shapes/${encodeURIComponent(id)}`, signal);
}

export function learnShape(board: string, runs: number): Promise<Job> {
  return postJson(`${ROOT}/targets/${encodeURIComponent(board)}/shape`, { runs });
}

export function certifyShape(id: string): Promise<BoardShape> {
  return postJson(`${ROOT}/board-shapes/${encodeURIComponent(id)}/certify`);
}

export function retireShape(id: string): Promise<BoardShape> {
  return postJson(`${ROOT}/board-shapes/${encodeURIComponent(id)}/retire`);
}

export function getJob(id: string, signal?: AbortSignal): Promise<Job> {
  return getJson(`${ROOT}/jobs/${encodeURIComponent(id)}`, signal);
}

export function getPattern(spec: string, signal?: AbortSignal): Promise<TargetPattern> {
  return getJson(`${ROOT}/targets/pattern?${new URLSearchParams({ spec }).toString()}`, signal);
}

/** A target's sheet to print; `paper` as the service names it, or auto. */
export function getSheet(spec: string, format: "pdf" | "svg", paper: string): Promise<NamedFile> {
  const query = new URLSearchParams({ spec, format, paper });
  return getFile(`${ROOT}/targets/sheet?${query.toString()}`);
}

export function getYield(sku: string, station: string, signal?: AbortSignal): Promise<Yield> {
  return getJson(yieldPath(sku, station), signal);
}

/** Images need the key too, so an <img src> cannot fetch them: they come as blobs. */
export async function getImage(url: string): Promise<Blob> {
  return (await request(url)).blob();
}
