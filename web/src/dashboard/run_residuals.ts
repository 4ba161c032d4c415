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

/** Captures that the solve did not use have no residuals and do not appear. */
export function residualsOf(details: CaptureDetails): Residuals {
  const byCapture = new Map<string, readonly RunCorner[]>();
  for (const { id, corners, reprojected } of details.values()) {
    if (reprojected === null) continue;
    const residuals = cornerResiduals(corners, reprojected);
    byCapture.set(
      id,
      residuals.map((residual, corner) => ({ ...residual, captureId: id, corner })),
    );
  }
  return { byCapture, all: [...byCapture.values()].flat() };
}

/** The longest residuals, the longest first. */
export function longest(all: readonly RunCorner[], count: number): RunCorner[] {
  return [...all].sort((a, b) => b.length - a.length).slice(0, count);
}
