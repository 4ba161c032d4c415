// Residuals of a run, per capture and all together, out of the captures' corners.
import { cornerResiduals, type CornerResidual } from "../drawing/residuals";
import type { CaptureDetails } from "./capture_details";

export interface Residuals {
  byCapture: ReadonlyMap<string, readonly CornerResidual[]>;
  all: readonly CornerResidual[];
}

/** Captures that no solve used have no residuals and do not appear; those of the fixed target are no part of all. */
export function residualsOf(details: CaptureDetails): Residuals {
  const byCapture = new Map<string, readonly CornerResidual[]>();
  const all: CornerResidual[] = [];
  for (const { id, role, corners, reprojected } of details.values()) {
    if (reprojected === null) continue;
    const residuals = cornerResiduals(corners, reprojected);
    byCapture.set(id, residuals);
    if (role === "intrinsics") all.push(...residuals);
  }
  return { byCapture, all };
}
