"""Pose of a flat target from one view: both solutions that a plane allows are weighed.

A plane seen from afar has two poses that explain it almost equally, one tilted towards and one away from the
camera. Both closed-form solutions (IPPE, Collins and Bartoli 2014) are refined on the real projection before
they are compared. Not here: intrinsics that are not known yet (`calibration`).
"""

from dataclasses import dataclass

import cv2
import numpy as np

from service.core.errors import PoseUndetermined
from service.core.vision.camera import LENSES, Intrinsics, project_with_jacobians, unproject
from service.core.vision.transforms import Array, Pose, angle_between, rotation_matrix, rotation_vector
from service.core.vision.virtual_view import turn_towards

CORNERS_NEEDED = 4
ITERATIONS = 30
SAME_POSE_RAD = 1e-2
CLEARLY_WORSE = 4.0  # times the squared error of the best solution


@dataclass(frozen=True)
class PoseEstimate:
    """A pose `T_cam_board`, its reprojection rms, and that of the other solution.

    The other's rms is inf where there is none: both closed forms lead to one pose once they are refined.
    """

    pose: Pose
    rms_px: float
    alternative_rms_px: float

    @property
    def ambiguity(self) -> float:
        """How nearly the other solution explains the view: 0 (certain) to 1 (either tilt is possible)."""
        return self.rms_px / self.alternative_rms_px if self.alternative_rms_px > 0 else 1.0


def estimate_pose(intrinsics: Intrinsics, object_points: Array, image_points: Array) -> PoseEstimate:
    """Return the pose of a flat target from object_points (n, 3) m at z = 0 and image_points (n, 2) px.

    Corners that the lens does not reach are left out. Raises PoseUndetermined for fewer than four usable
    corners or where no pose before the camera explains them.
    """
    rays = unproject(intrinsics, image_points)
    seen = np.all(np.isfinite(rays), axis=-1)
    board, pixels = np.asarray(object_points, float)[seen], np.asarray(image_points, float)[seen]
    if len(board) < CORNERS_NEEDED:
        raise PoseUndetermined(
            f"{len(board)} corners are within the reach of the lens and {CORNERS_NEEDED} are needed; "
            "show the target nearer to the middle of the image.",
            corners=len(board),
        )
    rotations, translations = _closed_form(board, rays[seen])
    rotations, translations, rms = _refine(intrinsics, rotations, translations, board, pixels)
    order = np.argsort(rms)
    if not np.isfinite(rms[order[0]]):
        raise PoseUndetermined(
            "No pose before the camera explains the corners; check the target and the intrinsics."
        )
    best, other = order[0], order[-1]
    apart = float(angle_between(rotations[best], rotations[other]))
    alternative = float(rms[other]) if apart > SAME_POSE_RAD else float("inf")
    return PoseEstimate(
        Pose(rotation_vector(rotations[best]), translations[best]), float(rms[best]), alternative
    )


def _closed_form(board: Array, rays: Array) -> tuple[Array, Array]:
    """Return rotations (s, 3, 3), translations (s, 3) of the one or two poses that fit directions (n, 3)."""
    towards, ideal = turn_towards(rays[None])
    try:
        _, rvecs, tvecs, _ = cv2.solvePnPGeneric(
            board, ideal[0], np.eye(3), np.zeros(4), flags=cv2.SOLVEPNP_IPPE
        )
    except cv2.error as error:
        raise PoseUndetermined("The corners do not span a plane; show the target less edge-on.") from error
    if len(rvecs) == 0:
        raise PoseUndetermined("The corners do not span a plane; show the target less edge-on.")
    for rvec, tvec in zip(rvecs, tvecs, strict=True):
        cv2.solvePnPRefineLM(board, ideal[0], np.eye(3), np.zeros(4), rvec, tvec)
    turns, shifts = np.array(rvecs, dtype=np.float64), np.array(tvecs, dtype=np.float64)
    return towards[0].T @ rotation_matrix(turns[..., 0]), shifts[..., 0] @ towards[0]


def _refine(
    intrinsics: Intrinsics, rotations: Array, translations: Array, board: Array, pixels: Array
) -> tuple[Array, Array, Array]:
    """Return poses of least reprojection error near the given ones (s), with their rms (s,) px.

    Levenberg–Marquardt on all solutions at once; the rms is inf where no pose is feasible.
    """
    damping: Array = np.full(len(rotations), 1e-3)
    settled = np.zeros(len(rotations), dtype=bool)
    cost, gradient, information = _normal_equations(intrinsics, rotations, translations, board, pixels)
    for _ in range(ITERATIONS):
        step = _damped_step(information, gradient, damping)
        moved_r, moved_t = rotation_matrix(step[:, :3]) @ rotations, translations + step[:, 3:]
        moved = _normal_equations(intrinsics, moved_r, moved_t, board, pixels)
        better = moved[0] < cost
        rotations = np.where(better[:, None, None], moved_r, rotations)
        translations = np.where(better[:, None], moved_t, translations)
        # Remembered, as the damping of a solution that has settled grows while the other still moves. One
        # that is clearly worse is only compared with, and may creep for long.
        slack = np.where(cost > CLEARLY_WORSE * cost.min(), 1e-4, 1e-12)
        settled |= (moved[0] >= cost * (1.0 - slack)) & (damping < 1.0)
        cost = np.where(better, moved[0], cost)
        gradient = np.where(better[:, None], moved[1], gradient)
        information = np.where(better[:, None, None], moved[2], information)
        damping = np.where(better, damping * 0.1, damping * 10.0)
        if settled.all():
            break
    return rotations, translations, np.sqrt(cost / len(board))


def _damped_step(information: Array, gradient: Array, damping: Array) -> Array:
    """Return Marquardt's steps (s, 6)."""
    diagonal = np.diagonal(information, axis1=-2, axis2=-1)
    damped = information + (damping[:, None] * diagonal)[..., None] * np.eye(6)
    return np.asarray(np.linalg.solve(damped, gradient[..., None])[..., 0], dtype=np.float64)


def _normal_equations(
    intrinsics: Intrinsics, rotations: Array, translations: Array, board: Array, pixels: Array
) -> tuple[Array, Array, Array]:
    """Return squared errors (s,), gradients (s, 6), information (s, 6, 6); inf where one is not shown."""
    projected, _, by_pose = project_with_jacobians(
        intrinsics.lens, intrinsics.vector, rotations, translations, board
    )
    J = by_pose.reshape(len(rotations), -1, 6)
    error = (pixels - projected).reshape(len(rotations), -1)
    points = board @ np.swapaxes(rotations, -1, -2) + translations[:, None]
    shown = LENSES[intrinsics.lens].radius(points).max(axis=1) < np.inf
    cost = np.where(shown, np.sum(error * error, axis=1), np.inf)
    Jt = np.swapaxes(J, -1, -2)
    return cost, (Jt @ error[..., None])[..., 0], Jt @ J
