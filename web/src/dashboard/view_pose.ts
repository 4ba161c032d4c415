// What a view's pose (rotation vector in rad, translation in m, board in camera) means to a reader.

type Vector = readonly number[];

export function distanceM(tvec: Vector): number {
  return Math.hypot(...tvec);
}

/** Angle between the board's normal and the camera's axis: acos of R33, by Rodrigues' formula. */
export function boardTiltDeg(rvec: Vector): number {
  const [x = 0, y = 0, z = 0] = rvec;
  const angle = Math.hypot(x, y, z);
  if (angle === 0) return 0;
  const along = (z / angle) ** 2;
  const cosine = Math.cos(angle) * (1 - along) + along;
  return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
}
