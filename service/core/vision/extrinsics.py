"""Extrinsics: where an installed camera is in the vehicle, from pictures of a target at a known place.

T_vehicle_cam = T_vehicle_board T_board_cam. All pictures show the same target from the same camera, so one
pose explains all their corners. What the result may be off comes from three sources that know nothing of each
other: the noise of the corners, the intrinsics' covariance, and how well the target's place is known. Not
here: limits (`service.core.quality`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from service.core.errors import PoseUndetermined
from service.core.vision.camera import Intrinsics, project, project_with_jacobians
from service.core.vision.pose import estimate_pose
from service.core.vision.transforms import Array, Pose, compose, invert, skew
from service.core.vision.view_stack import View


@dataclass(frozen=True)
class FixedTarget:
    """A target's place: T_vehicle_board, with sd per axis, m, of its origin and, rad, of its rotation.

    The rotation's error turns the board about its origin; the six errors are independent.
    """

    T_vehicle_board: Pose
    translation_sd_m: float
    rotation_sd_rad: float


@dataclass(frozen=True)
class Extrinsics:
    """T_vehicle_cam with its covariance, and what the pictures say of it.

    covariance, and its parts of_noise, of_intrinsics, of_fixture: (6, 6), of a left increment of the rotation
    in the vehicle frame, rad, then of the camera's position, m. residuals: detected − projected (n, 2) px per
    picture. sigma_px: √(Σe²/(2N − 6)); rms_px: √(Σ|e|²/N). ambiguity: as of `PoseEstimate`.
    image_agreement_px: rms distance of a picture's corners by its own pose from those by the common one, of
    the picture where it is largest; None for one picture.
    """

    T_vehicle_cam: Pose
    T_cam_board: Pose
    of_noise: Array
    of_intrinsics: Array
    of_fixture: Array
    residuals: tuple[Array, ...]
    sigma_px: float
    rms_px: float
    ambiguity: float
    image_agreement_px: float | None

    @property
    def covariance(self) -> Array:
        """The sum of its parts (6, 6)."""
        return self.of_noise + self.of_intrinsics + self.of_fixture

    @property
    def translation_sd_m(self) -> float:
        """Standard deviation of the position along the axis where it is largest, m."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance[3:, 3:])[-1]))

    @property
    def rotation_sd_rad(self) -> float:
        """Standard deviation of the rotation about the axis where it is largest, rad."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance[:3, :3])[-1]))


def estimate_extrinsics(
    views: Sequence[View], intrinsics: Intrinsics, covariance: Array, fixed: FixedTarget
) -> Extrinsics:
    """Return where the camera is, from pictures of a fixed target.

    covariance: (p, p) of the intrinsics. Both poses that a plane allows are weighed on the corners of all
    pictures. Raises PoseUndetermined without pictures or where no pose explains them.
    """
    if not views:
        raise PoseUndetermined("There is no picture of the fixed target; take one.")
    board = np.concatenate([view.object_points for view in views])
    pixels = np.concatenate([view.image_points for view in views])
    found = estimate_pose(intrinsics, board, pixels)
    pose = found.pose
    projected, A, B = _linearised(intrinsics, pose, board)
    errors = pixels - projected
    if not np.all(np.isfinite(errors)):
        raise PoseUndetermined(
            "The lens does not reach all corners of the fixed target; show it nearer to the image's middle."
        )
    squared = float(np.sum(errors**2))
    sigma_px = float(np.sqrt(squared / max(errors.size - 6, 1)))
    inverse = np.linalg.inv(B.T @ B)
    by_intrinsics = -inverse @ B.T @ A
    J = _by_pose(pose, fixed)
    T_vehicle_cam = compose(fixed.T_vehicle_board, invert(pose))
    return Extrinsics(
        T_vehicle_cam=T_vehicle_cam,
        T_cam_board=pose,
        of_noise=_repeated_variance(board, errors) * J @ inverse @ J.T,
        of_intrinsics=J @ by_intrinsics @ covariance @ by_intrinsics.T @ J.T,
        of_fixture=_of_fixture(fixed, T_vehicle_cam.tvec - fixed.T_vehicle_board.tvec),
        residuals=tuple(np.split(errors, np.cumsum([len(view.image_points) for view in views])[:-1])),
        sigma_px=sigma_px,
        rms_px=float(np.sqrt(squared / len(errors))),
        ambiguity=found.ambiguity,
        image_agreement_px=_agreement(views, intrinsics, pose),
    )


def _linearised(intrinsics: Intrinsics, pose: Pose, board: Array) -> tuple[Array, Array, Array]:
    """Return projections (n, 2) and their derivatives by the intrinsics (2n, p) and the pose (2n, 6)."""
    pixels, A, B = project_with_jacobians(
        intrinsics.lens, intrinsics.vector, pose.rotation[None], pose.tvec[None], board
    )
    return pixels[0], A[0].reshape(-1, A.shape[-1]), B[0].reshape(-1, 6)


def _by_pose(pose: Pose, fixed: FixedTarget) -> Array:
    """Return the derivative (6, 6) of T_vehicle_cam by T_cam_board, both as left increments.

    With T_cam_board = (R, t), R exp'd to exp(ω)R and t to t + τ: φ = −Q ω and δ = −Q (τ + t × ω), where Q is
    the rotation of T_vehicle_cam.
    """
    Q = fixed.T_vehicle_board.rotation @ pose.rotation.T
    J = np.zeros((6, 6))
    J[:3, :3] = J[3:, 3:] = -Q
    J[3:, :3] = -Q @ skew(pose.tvec)
    return J


def _of_fixture(fixed: FixedTarget, lever: Array) -> Array:
    """Return the covariance (6, 6) from the target's place; lever: (3,) m from its origin to the camera.

    α about the origin and β of it: φ = α, δ = β + α × lever.
    """
    J = np.eye(6)
    J[3:, :3] = -skew(lever)
    variances = np.repeat([fixed.rotation_sd_rad**2, fixed.translation_sd_m**2], 3)
    return np.asarray((J * variances) @ J.T, dtype=np.float64)


def _repeated_variance(board: Array, errors: Array) -> float:
    """Return the variance, px², that gives the pose's covariance when errors (n, 2) repeat in part.

    Camera and target stand still, so that what aliasing and print do to a corner is the same in each picture
    and is not averaged away: a corner's errors are added up before they are squared. Without such a part this
    is the variance of the noise.
    """
    corners, place = np.unique(board, axis=0, return_inverse=True)
    sums = np.zeros((len(corners), 2))
    np.add.at(sums, place.reshape(-1), errors)
    share = 2 * len(corners) / max(2 * len(corners) - 6, 1)
    return float(share * np.sum(sums**2) / (2 * len(errors)))


def _agreement(views: Sequence[View], intrinsics: Intrinsics, common: Pose) -> float | None:
    """Return how far a picture's own pose moves its corners at most, rms px; None for one picture."""
    if len(views) < 2:
        return None
    distances = []
    for view in views:
        own = estimate_pose(intrinsics, view.object_points, view.image_points).pose
        by_own, by_common = (
            project(intrinsics, pose.rotation, pose.tvec, view.object_points) for pose in (own, common)
        )
        distances.append(float(np.sqrt(np.mean(np.sum((by_own - by_common) ** 2, axis=-1)))))
    return max(distances)
