"""The captures that a person takes of a virtual vehicle at prescribed poses.

Not here: which camera it has (`core.vision.tolerance`), and guidance and the hand that follows it; this hand
is merely a little off the prescribed poses.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector
from service.simulator.renderer import PreparedScene
from service.simulator.scene import Scene, true_corners

RETRIES = 40
PULL_BACK = 0.003  # of the depth, per retry


@dataclass(frozen=True)
class Mismatch:
    """How far a hand is off a prescribed pose: half widths of uniform distributions per axis.

    position_m: of the target's centre; angle_rad: of the rotation about each axis; margin_px: how far
    inside the picture the hand keeps every corner, as its screen shows.
    """

    position_m: float = 0.003
    angle_rad: float = float(np.radians(1.0))
    margin_px: float = 10.0


@dataclass(frozen=True)
class VirtualCapture:
    """A picture (h, w) and the pose at which it was truly taken."""

    image: NDArray[np.uint8]
    pose: Pose


def take_captures(
    prepared: PreparedScene, poses: Sequence[Pose], mismatch: Mismatch, rng: np.random.Generator
) -> list[VirtualCapture]:
    """Return one capture per prescribed pose, each taken a little off it."""
    held = [hold_board(prepared.scene, pose, mismatch, rng) for pose in poses]
    return [VirtualCapture(prepared.render(pose, rng), pose) for pose in held]


def hold_board(scene: Scene, pose: Pose, mismatch: Mismatch, rng: np.random.Generator) -> Pose:
    """Return the pose a hand takes for a prescribed one.

    A hand that loses a corner over the picture's border tries again, with less mismatch but a little farther
    along the optical axis, which takes the board towards the middle of the picture: a camera that differs
    from its nominal may not show the prescribed pose whole. Ends at that pose if nothing shows it.
    """
    depth = (pose.rotation @ scene.target.centre + pose.tvec)[2]
    for attempt in range(RETRIES):
        share = 0.9**attempt
        farther = Pose(pose.rvec, pose.tvec + np.array([0.0, 0.0, PULL_BACK * attempt * depth]))
        held = _shake(scene.target, farther, share * mismatch.position_m, share * mismatch.angle_rad, rng)
        if _is_inside(true_corners(scene, held), scene.intrinsics.image_size, mismatch.margin_px):
            return held
    return pose


def _shake(target: Target, pose: Pose, position_m: float, angle_rad: float, rng: np.random.Generator) -> Pose:
    """Return a pose turned about the target's centre and shifted."""
    turn = rotation_matrix(rng.uniform(-angle_rad, angle_rad, 3))
    R = pose.rotation
    centre = R @ target.centre + pose.tvec + rng.uniform(-position_m, position_m, 3)
    return Pose(rotation_vector(turn @ R), centre - turn @ R @ target.centre)


def _is_inside(points: Array, image_size: tuple[int, int], margin_px: float) -> bool:
    """Return whether points (n, 2) px all lie in the picture, so far from its border; NaN does not."""
    last = np.array(image_size) - 1.0 - margin_px
    return bool(np.all((points >= margin_px) & (points <= last)))
