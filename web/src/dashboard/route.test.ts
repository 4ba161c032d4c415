import { describe, expect, it } from "vitest";
import { addressOf, parseRoute, type Route } from "./route";

const ROUTES: Route[] = [
  { page: "runs", filter: {} },
  { page: "runs", filter: { serial: "VIN 1/2&3" } },
  { page: "runs", filter: { sku: "lens1", station: "cal-2", verdict: "FAIL", failed: "rms_px" } },
  { page: "run", id: "0198-7", capture: "" },
  { page: "run", id: "0198-7", capture: "12" },
  { page: "compare", a: "0198-7", b: "0198-8" },
  { page: "compare", a: "", b: "" },
  { page: "vehicle", serial: "VIN/ä 100%" },
  { page: "stations" },
  { page: "skus" },
  { page: "sku", code: "lens1", poseSet: "" },
  { page: "sku", code: "lens1", poseSet: "0198-7" },
  { page: "targets" },
  { page: "target", spec: "chessboard:9x6:25mm" },
  { page: "board", board: "BOARD 1/2", shape: "" },
  { page: "board", board: "BOARD-1", shape: "3" },
  { page: "poseSet", id: "0198-7", with: "" },
  { page: "poseSet", id: "0198-7", with: "0198-8" },
  { page: "yield", sku: "", station: "" },
  { page: "yield", sku: "lens1", station: "cal1" },
];

describe("addresses of pages", () => {
  it.each(ROUTES)("lead back to the page they were made for: %j", (route) => {
    expect(parseRoute(addressOf(route))).toEqual(route);
  });

  it.each(["", "#", "#/", "#/nowhere", "#/vehicles/", "#/runs/"])("lead to the runs from %j", (hash) => {
    expect(parseRoute(hash)).toEqual({ page: "runs", filter: {} });
  });

  it("survive a broken escape", () => {
    expect(parseRoute("#/vehicles/%E0%A4%A")).toEqual({ page: "vehicle", serial: "%E0%A4%A" });
  });
});
