// Addresses of the dashboard's pages. They live behind the hash, so the service needs to know one page only.
import { filterFrom, queryOf, type RunFilter } from "./run_filter";

export type Route =
  | { page: "runs"; filter: RunFilter }
  /** `capture`: number of the capture on show, or nothing. */
  | { page: "run"; id: string; capture: string }
  | { page: "compare"; a: string; b: string }
  | { page: "vehicle"; serial: string }
  | { page: "stations" }
  | { page: "skus" }
  | { page: "poseSet"; id: string; with: string }
  | { page: "sku"; code: string; poseSet: string }
  | { page: "targets" }
  | { page: "target"; spec: string }
  /** `board`: serial or id; `shape`: version of the shape on show, or nothing. */
  | { page: "board"; board: string; shape: string }
  | { page: "yield"; sku: string; station: string };

export function parseRoute(hash: string): Route {
  const [path = "", search = ""] = hash.replace(/^#\/?/, "").split("?");
  const [page = "", ...rest] = path.split("/");
  const name = decode(rest.join("/"));
  const query = new URLSearchParams(search);
  return (name === "" ? listRoute(page, query) : oneRoute(page, name, query)) ?? runsRoute(query);
}

function runsRoute(query: URLSearchParams): Route {
  return { page: "runs", filter: filterFrom(query) };
}

function listRoute(page: string, query: URLSearchParams): Route | null {
  if (page === "skus" || page === "stations" || page === "targets") return { page };
  if (page === "compare") return { page, a: query.get("a") ?? "", b: query.get("b") ?? "" };
  if (page !== "yield") return null;
  return { page, sku: query.get("sku") ?? "", station: query.get("station") ?? "" };
}

function oneRoute(page: string, name: string, query: URLSearchParams): Route | null {
  if (page === "runs") return { page: "run", id: name, capture: query.get("capture") ?? "" };
  if (page === "targets") return { page: "target", spec: name };
  if (page === "boards") return { page: "board", board: name, shape: query.get("shape") ?? "" };
  if (page === "vehicles") return { page: "vehicle", serial: name };
  if (page === "pose-sets") return { page: "poseSet", id: name, with: query.get("with") ?? "" };
  if (page === "skus") return { page: "sku", code: name, poseSet: query.get("pose_set") ?? "" };
  return null;
}

export function addressOf(route: Route): string {
  switch (route.page) {
    case "run":
      return withQuery(`#/runs/${encodeURIComponent(route.id)}`, { capture: route.capture });
    case "compare":
      return withQuery("#/compare", { a: route.a, b: route.b });
    case "vehicle":
      return `#/vehicles/${encodeURIComponent(route.serial)}`;
    case "target":
      return `#/targets/${encodeURIComponent(route.spec)}`;
    case "board":
      return withQuery(`#/boards/${encodeURIComponent(route.board)}`, { shape: route.shape });
    case "poseSet":
      return withQuery(`#/pose-sets/${encodeURIComponent(route.id)}`, { with: route.with });
    case "sku":
      return withQuery(`#/skus/${encodeURIComponent(route.code)}`, { pose_set: route.poseSet });
    case "yield":
      return withQuery("#/yield", { sku: route.sku, station: route.station });
    case "runs":
      return runsAddress(queryOf(route.filter));
    default:
      return `#/${route.page}`;
  }
}

function runsAddress(query: string): string {
  return query === "" ? "#/runs" : `#/runs?${query}`;
}

function withQuery(path: string, values: Record<string, string>): string {
  const query = new URLSearchParams(Object.entries(values).filter(([, value]) => value !== ""));
  return query.size === 0 ? path : `${path}?${query.toString()}`;
}

function decode(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
