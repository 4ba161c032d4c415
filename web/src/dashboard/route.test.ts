import { describe, expect, it } from "vitest";
import { addressOf, parseRoute, type Route } from "./route";

const ROUTES: Route[] = [
  { page: "runs", serial: "" },
  { page: "runs", serial: "VIN 1/2&3" },
  { page: "run", id: "0198-7" },
  { page: "vehicle", serial: "VIN/ä 100%" },
];

describe("addresses of pages", () => {
  it.each(ROUTES)("lead back to the page they were made for: %j", (route) => {
    expect(parseRoute(addressOf(route))).toEqual(route);
  });

  it.each(["", "#", "#/", "#/nowhere", "#/vehicles/", "#/runs/"])("lead to the runs from %j", (hash) => {
    expect(parseRoute(hash)).toEqual({ page: "runs", serial: "" });
  });

  it("survive a broken escape", () => {
    expect(parseRoute("#/vehicles/%E0%A4%A")).toEqual({ page: "vehicle", serial: "%E0%A4%A" });
  });
});
