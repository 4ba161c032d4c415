"""Plans that hold for every camera of a SKU and for hands that only nearly hit the pose.

A set is judged by its average over draws: a camera within the SKU's tolerance, and every pose a little off.
Not here: how far off a capture may be to be taken (`guidance`).
"""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from service.core.planning.candidates import Candidates
from service.core.planning.information import pose_information
from service.core.planning.pose_space import Poses
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array, rotation_matrix

DRAWS: Final = 8


@dataclass(frozen=True)
class Slack:
    """How far a captured board is off its pose: half widths of uniform distributions.

    image_share: of the board's centre along each image axis, over the image width; depth_share: of the depth;
    angle_rad: of the rotation about each camera axis. Together they move the outer corners by about the
    2 % of the image width that a capture may be off.
    """

    image_share: float = 0.01
    depth_share: float = 0.02
    angle_rad: float = float(np.deg2rad(4.0))


@dataclass(frozen=True)
class Robustness:
    """Over how many draws a set is judged (the first is the nominal camera at the exact poses), and of
    what."""

    draws: int = DRAWS
    tolerance: Tolerance = field(default_factory=Tolerance)
    slack: Slack = field(default_factory=Slack)


NOMINAL_ONLY: Final = Robustness(draws=1)


def information_by_draw(
    intrinsics: Intrinsics,
    target: Target,
    given: Candidates,
    *,
    robustness: Robustness,
    rng: np.random.Generator,
) -> Array:
    """Return the information (d, m, p, p) of m candidates in each of d draws."""
    draws = [pose_information(intrinsics, target, given.poses, given.sigma_px)]
    for _ in range(robustness.draws - 1):
        camera = draw_camera(intrinsics, robustness.tolerance, rng)
        held = _held(camera, target, given.poses, robustness.slack, rng)
        draws.append(pose_information(camera, target, held, given.sigma_px))
    return np.stack(draws)


def _held(camera: Intrinsics, target: Target, poses: Poses, slack: Slack, rng: np.random.Generator) -> Poses:
    """Return the poses as hands hold them."""
    m = len(poses)
    turns = rotation_matrix(rng.uniform(-slack.angle_rad, slack.angle_rad, (m, 3)))
    centres = poses.centres(target)
    aside = slack.image_share * camera.image_size[0] / camera.camera_matrix[0, 0] * centres[:, 2:]
    shifts = rng.uniform(-1.0, 1.0, (m, 3)) * np.hstack([aside, aside, slack.depth_share * centres[:, 2:]])
    rotations = turns @ poses.rotations
    return Poses(rotations, centres + shifts - rotations @ target.centre)
