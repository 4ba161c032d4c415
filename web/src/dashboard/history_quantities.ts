// What a history shows of each calibration: the camera's four pixel parameters, and the rms.
import type { PastCalibration } from "../generated/api";

export const QUANTITIES = ["fx", "fy", "cx", "cy", "rms"] as const;
export type QuantityName = (typeof QUANTITIES)[number];

export function quantityOf(one: PastCalibration, name: QuantityName): { value: number; sd: number | null } {
  if (name === "rms") return { value: one.rms_px, sd: null };
  return { value: one.intrinsics[name] ?? Number.NaN, sd: one.sd[name] ?? null };
}

/** The calibration before that of a run, or null; calibrations come oldest first. */
export function previousOf(calibrations: readonly PastCalibration[], runId: string): string | null {
  const at = calibrations.findIndex(({ run_id }) => run_id === runId);
  return at > 0 ? (calibrations[at - 1]?.run_id ?? null) : null;
}
