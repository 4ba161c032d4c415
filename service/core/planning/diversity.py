"""How varied a set of poses is: tilt about both axes, distance, coverage of the image.

A varied set is what the optimum looks like; where it does not, the pose space forbids it. Not here: the
accuracy that follows (`scoring`).
"""

from dataclasses import dataclass
from typing import Final

import cv2
import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.pose_space import Poses
from service.core.vision.target import Target
from service.core.vision.transforms import Array

SMALLEST_TILT_SPREAD_DEG: Final = 10.0


@dataclass(frozen=True)
class Diversity:
    """pitch_spread_deg, yaw_spread_deg: range of the tilt that moves the top and bottom, left and right edge.

    distance_ratio: farthest over nearest board centre. coverage: share of the image within the hull of all
    corners.
    """

    pitch_spread_deg: float
    yaw_spread_deg: float
    distance_ratio: float
    coverage: float


def measure_diversity(
    poses: Poses, target: Target, image_points: Array, image_size: tuple[int, int]
) -> Diversity:
    """Return how varied m poses are; image_points (m, n, 2) px are their corners."""
    normals = poses.rotations[:, :, 2]
    tilts = np.rad2deg(np.arcsin(np.clip(normals[:, :2], -1.0, 1.0)))
    yaw_spread, pitch_spread = np.ptp(tilts, axis=0)
    distances = np.linalg.norm(poses.centres(target), axis=1)
    hull = cv2.convexHull(image_points.reshape(-1, 2).astype(np.float32))
    return Diversity(
        pitch_spread_deg=float(pitch_spread),
        yaw_spread_deg=float(yaw_spread),
        distance_ratio=float(distances.max() / distances.min()),
        coverage=float(cv2.contourArea(hull)) / (image_size[0] * image_size[1]),
    )


def check_diversity(diversity: Diversity) -> Diversity:
    """Return the diversity, or raise PoseSetInfeasible where boards are not tilted about both axes."""
    for bound, spread in (("yaw_deg", diversity.yaw_spread_deg), ("pitch_deg", diversity.pitch_spread_deg)):
        if spread < SMALLEST_TILT_SPREAD_DEG:
            raise PoseSetInfeasible(
                f"The boards are tilted by only {spread:.1f} degrees in {bound}; a camera is determined "
                f"reliably only with {SMALLEST_TILT_SPREAD_DEG:g} degrees about each axis; widen {bound}.",
                bound=bound,
                spread_deg=spread,
            )
    return diversity
