// The page that the address asks for, followed as it changes.
import { signal } from "@preact/signals";
import { parseRoute, type Route } from "./route";

export const route = signal<Route>({ page: "runs", filter: {} });

export function followAddress(): void {
  const read = (): void => {
    route.value = parseRoute(window.location.hash);
  };
  read();
  window.addEventListener("hashchange", read);
}
