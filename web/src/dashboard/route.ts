// Addresses of the dashboard's pages. They live behind the hash, so the service needs to know one page only.

export type Route =
  { page: "runs"; serial: string } | { page: "run"; id: string } | { page: "vehicle"; serial: string };

export function parseRoute(hash: string): Route {
  const [path = "", query = ""] = hash.replace(/^#\/?/, "").split("?");
  const [page, ...rest] = path.split("/");
  const name = decode(rest.join("/"));
  if (page === "runs" && name !== "") return { page: "run", id: name };
  if (page === "vehicles" && name !== "") return { page: "vehicle", serial: name };
  return { page: "runs", serial: new URLSearchParams(query).get("serial") ?? "" };
}

export function addressOf(route: Route): string {
  if (route.page === "run") return `#/runs/${encodeURIComponent(route.id)}`;
  if (route.page === "vehicle") return `#/vehicles/${encodeURIComponent(route.serial)}`;
  return route.serial === ""
    ? "#/runs"
    : `#/runs?${new URLSearchParams({ serial: route.serial }).toString()}`;
}

function decode(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
