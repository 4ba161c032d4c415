"""Pose of a flat target from one view: both solutions that a plane allows are weighed.

A plane seen from afar has two poses that explain it almost equally, one tilted towards and one away from the
camera. Both closed-form solutions (IPPE, Collins and Bartoli 2014) are refined on the real projection before
they are compared. Where neither explains the view, because the focal length is not what it is said to be,
their errors are mostly its own and may favour the wrong tilt: then a free focal length decides between them.
Not here: intrinsics that are not known yet (`calibration`).
"""

from dataclasses import dataclass

import cv2
import numpy as np

from service.core.errors import PoseUndetermined
from service.core.vision.camera import LENSES, Intrinsics, project_with_jacobians, unproject
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector
from service.core.vision.virtual_view import turn_towards

CORNERS_NEEDED = 4
ITERATIONS = 30
SAME_POSE_RAD = 1e-2
FIRST_STEPS = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 6, 1e-5)
CLEARLY_WORSE = 4.0  # times the squared error of the best solution
ROUNDING = 1e-5  # of the cost: where so little is promised and nothing is gained
MISFIT_PX = 1.0  # rms from which the intrinsics are wrong; corners of live frames are off by 0.3 px at most
LIKE_RMS = 4.0  # times the least rms, up to which wrong intrinsics may have changed which one is the least
EXPLAINED_PX = 2.0  # rms below which a camera explains a view, its focal length being held near the given one
FOCAL_SHARES = (1.0, 1.2, 1.0 / 1.2)  # from where a free focal length is looked for
FOCAL_SD = 0.2  # of the logarithm of a free focal length, against corners off by MISFIT_PX


@dataclass(frozen=True)
class PoseEstimate:
    """A pose `T_cam_board`, its reprojection rms, and that of the other solution.

    The other's rms is inf where there is none: both closed forms lead to one pose once they are refined.
    freed: where the intrinsics are wrong, the best pose by a camera of another focal length, and that camera.
    """

    pose: Pose
    rms_px: float
    alternative_rms_px: float
    freed: tuple[Pose, Intrinsics] | None = None

    @property
    def ambiguity(self) -> float:
        """How nearly the other solution explains the view: 0 (certain) to 1 (either tilt is possible)."""
        return min(1.0, self.rms_px / self.alternative_rms_px) if self.alternative_rms_px > 0 else 1.0


def estimate_pose(intrinsics: Intrinsics, object_points: Array, image_points: Array) -> PoseEstimate:
    """Return the pose of a flat target from object_points (n, 3) m at z = 0 and image_points (n, 2) px.

    Corners that the lens does not reach are left out. Raises PoseUndetermined for fewer than four usable
    corners or where no pose before the camera explains them.
    """
    (board, pixels), (rotations, translations) = _starts(intrinsics, object_points, image_points)
    rotations, translations, rms, _ = _refine(intrinsics, rotations, translations, board, pixels)
    if not np.isfinite(rms.min()):
        raise PoseUndetermined(
            "No pose before the camera explains the corners; check the target and the intrinsics."
        )
    best, freed = int(np.argmin(rms)), None
    if rms[best] > MISFIT_PX:
        freed = _freed(intrinsics, object_points, image_points)
        if rms.max() < LIKE_RMS * rms[best]:
            best = int(np.argmin(np.linalg.norm(rotations - freed[0].rotation, axis=(1, 2))))
    other = len(rms) - 1 - best
    # The norm of a difference of rotations is √8 times the sine of half the angle between them.
    apart = float(np.linalg.norm(rotations[best] - rotations[other])) / np.sqrt(2.0)
    alternative = float(rms[other]) if apart > SAME_POSE_RAD else float("inf")
    return PoseEstimate(
        Pose(rotation_vector(rotations[best]), translations[best]), float(rms[best]), alternative, freed
    )


def fit_pose(intrinsics: Intrinsics, start: Pose, object_points: Array, image_points: Array) -> Pose:
    """Return the pose of least reprojection error near a start, for points as in `estimate_pose`."""
    rotation, translation, _, _ = _refine(
        intrinsics, start.rotation[None], start.tvec[None], object_points, image_points
    )
    return Pose(rotation_vector(rotation[0]), translation[0])


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
        cv2.solvePnPRefineLM(board, ideal[0], np.eye(3), np.zeros(4), rvec, tvec, FIRST_STEPS)
    turns, shifts = np.array(rvecs, dtype=np.float64), np.array(tvecs, dtype=np.float64)
    return towards[0].T @ rotation_matrix(turns[..., 0]), shifts[..., 0] @ towards[0]


def _freed(intrinsics: Intrinsics, object_points: Array, image_points: Array) -> tuple[Pose, Intrinsics]:
    """Return the best pose by a camera with a free focal length, and that camera.

    From the given focal length the way may end at the fold of a strongly bent lens; then from others.
    """
    least = np.inf
    best = Pose(np.zeros(3), np.zeros(3)), intrinsics
    for share in FOCAL_SHARES:
        camera = _with_focal(intrinsics, share)
        try:
            (board, pixels), (turned, moved) = _starts(camera, object_points, image_points)
        except PoseUndetermined:
            continue
        turned, moved, rms, growth = _refine(camera, turned, moved, board, pixels, free_focal=True)
        i = int(np.argmin(rms))
        if rms[i] < least:
            least = float(rms[i])
            best = Pose(rotation_vector(turned[i]), moved[i]), _with_focal(camera, np.exp(growth[i, 0]))
        if least < EXPLAINED_PX:
            break
    return best


def _with_focal(intrinsics: Intrinsics, share: float) -> Intrinsics:
    """Return the camera with its focal lengths multiplied."""
    vector = intrinsics.vector
    vector[:2] *= share
    return Intrinsics.from_vector(intrinsics.lens, vector, intrinsics.image_size)


def _starts(
    intrinsics: Intrinsics, object_points: Array, image_points: Array
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Return the corners that the lens reaches, board (n, 3) and pixels (n, 2), and the poses that fit them.

    Rotations (s, 3, 3) and translations (s, 3) of one or two. Raises PoseUndetermined for too few corners.
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
    return (board, pixels), _closed_form(board, rays[seen])


def _refine(
    intrinsics: Intrinsics,
    rotations: Array,
    translations: Array,
    board: Array,
    pixels: Array,
    *,
    free_focal: bool = False,
) -> tuple[Array, Array, Array, Array]:
    """Return poses of least reprojection error near the given ones (s), with their rms (s,) px and growth.

    Levenberg–Marquardt on all solutions at once; the rms is inf where no pose is feasible. free_focal: each
    with a focal length of its own, which is held near the given one by FOCAL_SD; it counts in the rms.
    """
    damping: Array = np.full(len(rotations), 1e-3)
    settled = np.zeros(len(rotations), dtype=bool)
    growth: Array = np.zeros((len(rotations), int(free_focal)))
    seen = _View(intrinsics, board, pixels)
    cost, gradient, information = seen.normal_equations(rotations, translations, growth)
    for _ in range(ITERATIONS):
        step = _damped_step(information, gradient, damping)
        # What is clearly worse is only compared with, and a free focal length hardly matters where it creeps.
        slack = np.where((cost > CLEARLY_WORSE * cost.min()) | free_focal, 1e-4, 1e-9)
        # Remembered, as the damping of a solution that has settled grows while the other still moves.
        promised = np.sum(step * gradient, axis=1)
        settled |= (promised <= slack * cost) & (damping < 1.0)
        if settled.all():
            break
        moved_r, moved_t = rotation_matrix(step[:, :3]) @ rotations, translations + step[:, 3:6]
        moved_f = growth + step[:, 6:]
        moved = seen.normal_equations(moved_r, moved_t, moved_f)
        better = moved[0] < cost
        rotations = np.where(better[:, None, None], moved_r, rotations)
        translations = np.where(better[:, None], moved_t, translations)
        growth = np.where(better[:, None], moved_f, growth)
        # A free focal length overshoots at first; of a plain pose a step in vain is the last but rounding.
        vain = (promised <= ROUNDING * cost) if free_focal else (damping < 1.0)
        settled |= (moved[0] >= cost * (1.0 - 1e-12)) & vain
        cost = np.where(better, moved[0], cost)
        gradient = np.where(better[:, None], moved[1], gradient)
        information = np.where(better[:, None, None], moved[2], information)
        damping = np.where(better, damping * 0.1, damping * 10.0)
    return rotations, translations, np.sqrt(cost / len(board)), growth


def _damped_step(information: Array, gradient: Array, damping: Array) -> Array:
    """Return Marquardt's steps (s, k)."""
    diagonal = np.diagonal(information, axis1=-2, axis2=-1)
    damped = information + (damping[:, None] * diagonal)[..., None] * np.eye(gradient.shape[-1])
    return np.asarray(np.linalg.solve(damped, gradient[..., None])[..., 0], dtype=np.float64)


@dataclass(frozen=True)
class _View:
    """Corners board (n, 3) m seen at pixels (n, 2) by a camera."""

    intrinsics: Intrinsics
    board: Array
    pixels: Array

    def normal_equations(
        self, rotations: Array, translations: Array, growth: Array
    ) -> tuple[Array, Array, Array]:
        """Return squared errors (s,), gradients (s, 6 + g), information (s, 6 + g, 6 + g).

        growth: (s, g), the logarithm of a free focal length over the given one, g = 1, or none, g = 0. Errors
        are inf where a solution is not shown.
        """
        lens, vector = self.intrinsics.lens, np.tile(self.intrinsics.vector, (len(growth), 1))
        vector[:, :2] *= np.exp(growth.sum(axis=1, keepdims=True))
        projected, _, by_pose = project_with_jacobians(lens, vector, rotations, translations, self.board)
        points = self.board @ np.swapaxes(rotations, -1, -2) + translations[:, None]
        shown = LENSES[lens].radius(points).max(axis=1) < np.inf
        J = by_pose.reshape(len(rotations), -1, 6)
        error = (self.pixels - projected).reshape(len(rotations), -1)
        if growth.size:
            J, error = self._with_growth(J, error, projected, growth)
        cost = np.where(shown, np.sum(error * error, axis=1), np.inf)
        Jt = np.swapaxes(J, -1, -2)
        return cost, (Jt @ error[..., None])[..., 0], Jt @ J

    def _with_growth(self, J: Array, error: Array, projected: Array, growth: Array) -> tuple[Array, Array]:
        """Return J (s, 2n, 6) and errors (s, 2n) with the growth's column and what holds it as a row more."""
        by_growth = (projected - self.intrinsics.vector[2:4]).reshape(len(growth), -1, 1)
        hold = np.sqrt(len(self.board)) * MISFIT_PX / FOCAL_SD
        row = np.tile(hold * np.eye(7)[6], (len(growth), 1, 1))
        whole = np.concatenate([np.concatenate([J, by_growth], axis=-1), row], axis=1)
        return whole, np.concatenate([error, -hold * growth], axis=1)
