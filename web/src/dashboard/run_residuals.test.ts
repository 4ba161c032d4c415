import { describe, expect, it } from "vitest";
import type { CaptureDetail } from "../generated/api";
import { longest, residualsOf } from "./run_residuals";

function detail(
  id: string,
  reprojected: [number, number][] | null,
  role = "intrinsics",
): [string, CaptureDetail] {
  const corners: [number, number][] = [
    [10, 10],
    [20, 10],
  ];
  return [id, { id, role, corners, reprojected } as unknown as CaptureDetail];
}

const DETAILS = new Map([
  detail("a", [
    [10, 10.5],
    [20, 10],
  ]),
  detail("b", null),
  detail("c", [
    [10, 10],
    [17, 6],
  ]),
  detail(
    "fixed",
    [
      [10, 30],
      [20, 10],
    ],
    "extrinsics",
  ),
]);

describe("residuals of a run", () => {
  it("know which capture and corner they come from", () => {
    const { all, byCapture } = residualsOf(DETAILS);
    expect(all.map(({ captureId, corner }) => [captureId, corner])).toEqual([
      ["a", 0],
      ["a", 1],
      ["c", 0],
      ["c", 1],
    ]);
    expect([...byCapture.keys()]).toEqual(["a", "c", "fixed"]);
  });

  it("are listed from the longest on", () => {
    const [first, second] = longest(residualsOf(DETAILS).all, 2);
    expect([first?.captureId, first?.corner, first?.length]).toEqual(["c", 1, 5]);
    expect([second?.captureId, second?.corner]).toEqual(["a", 0]);
  });
});
