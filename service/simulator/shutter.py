"""A picture that takes time: a board that moves while the shutter is open is smeared along its way.

Not here: what is seen at one moment (`renderer`), and who moves the board.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector
from service.simulator.renderer import PreparedScene
from service.simulator.scene import true_corners
from service.simulator.sensor import expose

SLICE_PX: Final = 0.3  # the farthest that a corner moves within one slice of the exposure
MOST_SLICES: Final = 24


def take_picture(
    prepared: PreparedScene, opened: Pose, closed: Pose, rng: np.random.Generator
) -> NDArray[np.uint8]:
    """Return the picture (h, w) of a board that moved evenly from one pose to another while it was taken.

    The light of slices of the exposure is averaged before the sensor reads it; a board that hardly moves
    needs one slice.
    """
    scene = prepared.scene
    slices = _slices(true_corners(scene, closed) - true_corners(scene, opened))
    light = np.zeros_like(prepared.background)
    for i in range(slices):
        light += prepared.light(between(opened, closed, (i + 0.5) / slices, scene.target))
    return expose(light / slices, scene, rng)


def between(start: Pose, end: Pose, share: float, target: Target) -> Pose:
    """Return the pose after a share of the way: the target's centre goes straight, the turn is even."""
    turn = rotation_matrix(share * rotation_vector(end.rotation @ start.rotation.T))
    R = turn @ start.rotation
    begin, stop = (pose.rotation @ target.centre + pose.tvec for pose in (start, end))
    return Pose(rotation_vector(R), begin + share * (stop - begin) - R @ target.centre)


def _slices(motion: Array) -> int:
    """Return into how many slices an exposure is cut in which corners (n, 2) px move so far."""
    farthest = float(np.nanmax(np.linalg.norm(motion, axis=1), initial=0.0))
    return int(np.clip(np.ceil(farthest / SLICE_PX), 1, MOST_SLICES))
