"""A pose set explained pose by pose: where each board is, how it is turned, what the set loses without it.

Not here: what the set promises over the image (`image_maps`), how it was found (`optimiser`).
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from service.core.planning.pose_space import Indices, Poses
from service.core.planning.scoring import LARGEST_CONDITION, condition_number, expected_covariance
from service.core.planning.visibility import measure_visibility
from service.core.vision.camera import Intrinsics, project
from service.core.vision.feature_grid import extent
from service.core.vision.target import Target
from service.core.vision.transforms import Array

# Points of the outline per square: enough for a lens to bend a side visibly.
OUTLINE_STEPS: Final = 2


@dataclass(frozen=True)
class PoseReview:
    """One pose of a set, camera frame, m, deg, px.

    centre_m: (3,) middle of the corners. rotation: (3, 3) of `T_cam_board`. distance_m: of the centre from
    the camera. tilt_deg: between the board's normal and the optical axis. pitch_deg, yaw_deg, roll_deg: as
    the pose space names them, R = R_y(yaw) R_x(pitch) R_z(roll). outline_px: (k, 2) the image of the line
    around the outermost corners, which bends with the lens; the last point joins the first.
    plate_corners_m: (4, 3) corners of the printed pattern, in the order of `Target.outer_corners`.
    """

    centre_m: Array
    rotation: Array
    distance_m: float
    tilt_deg: float
    pitch_deg: float
    yaw_deg: float
    roll_deg: float
    outline_px: Array
    plate_corners_m: Array
    smallest_square_px: float


def review_poses(intrinsics: Intrinsics, target: Target, poses: Poses) -> list[PoseReview]:
    """Return what each of m poses is, in their order."""
    R = poses.rotations
    centres = poses.centres(target)
    seen = measure_visibility(intrinsics, target, R, poses.translations)
    outlines = project(intrinsics, R, poses.translations, outline_points(target))
    plates = target.outline @ np.swapaxes(R, 1, 2) + poses.translations[:, None, :]
    angles = pitch_yaw_roll(R)
    tilts = np.arccos(np.clip(R[:, 2, 2], -1.0, 1.0))
    return [
        PoseReview(
            centre_m=centres[i],
            rotation=R[i],
            distance_m=float(np.linalg.norm(centres[i])),
            tilt_deg=float(np.rad2deg(tilts[i])),
            pitch_deg=float(np.rad2deg(angles[i, 0])),
            yaw_deg=float(np.rad2deg(angles[i, 1])),
            roll_deg=float(np.rad2deg(angles[i, 2])),
            outline_px=outlines[i],
            plate_corners_m=plates[i],
            smallest_square_px=float(seen.smallest_square_px[i]),
        )
        for i in range(len(poses))
    ]


def pitch_yaw_roll(rotations: Array) -> Array:
    """Return the angles (m, 3), rad, with R = R_y(yaw) R_x(pitch) R_z(roll) of rotations (m, 3, 3)."""
    R = rotations
    pitch = np.arcsin(np.clip(-R[:, 1, 2], -1.0, 1.0))
    yaw = np.arctan2(R[:, 0, 2], R[:, 2, 2])
    roll = np.arctan2(R[:, 1, 0], R[:, 1, 1])
    return np.stack([pitch, yaw, roll], axis=-1)


def outline_points(target: Target) -> Array:
    """Return points (k, 3), m, of the board around its outermost features, clockwise from feature 0."""
    low, high = extent(target.object_points)
    width, height = (round(side / target.square_m) for side in high - low)
    across, down = (np.arange(OUTLINE_STEPS * n) / (OUTLINE_STEPS * n) for n in (width, height))
    x = np.concatenate([across, np.ones(len(down)), 1.0 - across, np.zeros(len(down))])
    y = np.concatenate([np.zeros(len(across)), down, np.ones(len(across)), 1.0 - down])
    return np.stack([x * (high - low)[0], y * (high - low)[1], np.zeros(len(x))], axis=-1)


def losses_without(information: Array, metric: Array, free: Indices) -> list[float | None]:
    """Return, for each of m poses, by how much √tr(WΣ) grows when it is left out: 0.1 is 10 % more.

    information: (m, p, p) of the poses. metric: W (p, p), for example the mapping metric of a zone. free:
    the parameters that are estimated. None where the other poses do not determine the camera.
    """
    pick = np.ix_(free, free)
    parts = information[:, free[:, None], free]
    whole = _expected(parts.sum(axis=0), metric[pick])
    rest = [parts.sum(axis=0) - part for part in parts]
    return [
        _expected(one, metric[pick]) / whole - 1.0 if condition_number(one) <= LARGEST_CONDITION else None
        for one in rest
    ]


def _expected(information: Array, metric: Array) -> float:
    return float(np.sqrt(np.sum(metric * expected_covariance(information))))
