// Residuals of a run, per capture and all together, out of the captures' corners.
import { cornerResiduals, type CornerResidual } from "../drawing/residuals";
import type { CaptureDetails } from "./capture_details";

/** A residual and where it comes from. */
export interface RunCorner extends CornerResidual {
  captureId: string;
  corner: number;
}

/** What is on show of a run: a capture, and in it a corner or none. */
export interface Spot {
  captureId: string;
  corner: number | null;
}

export interface Residuals {
  byCapture: ReadonlyMap<string, readonly RunCorner[]>;
  all: readonly RunCorner[];
}

/** Captures that no solve used have no residuals and do not appear; those of the fixed target are no part of all. */
export function residualsOf(details: CaptureDetails): Residuals {
  const byCapture = new Map<string, readonly RunCorner[]>();
  const all: RunCorner[] = [];
  for (const { id, role, corners, reprojected } of details.values()) {
    if (reprojected === null) continue;
    const residuals = cornerResiduals(corners, reprojected).map((residual, corner) => ({
      ...residual,
      captureId: id,
      corner,
    }));
    byCapture.set(id, residuals);
    if (role === "intrinsics") all.push(...residuals);
  }
  return { byCapture, all };
}

/** The longest residuals, the longest first. */
export function longest(all: readonly RunCorner[], count: number): RunCorner[] {
  return [...all].sort((a, b) => b.length - a.length).slice(0, count);
}
