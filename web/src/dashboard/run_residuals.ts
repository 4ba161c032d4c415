// Residuals of a run, per capture and all together, out of the captures' corners.
import { cornerResiduals, type CornerResidual } from "../drawing/residuals";
import type { CaptureDetails } from "./capture_details";

export interface Residuals {
  byCapture: ReadonlyMap<string, readonly CornerResidual[]>;
  all: readonly CornerResidual[];
}

/** Captures that the solve did not use have no residuals and do not appear. */
export function residualsOf(details: CaptureDetails): Residuals {
  const byCapture = new Map<string, readonly CornerResidual[]>();
  for (const { id, corners, reprojected } of details.values()) {
    if (reprojected !== null) byCapture.set(id, cornerResiduals(corners, reprojected));
  }
  return { byCapture, all: [...byCapture.values()].flat() };
}
