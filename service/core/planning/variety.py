"""What every set must hold, however little the optimum cares: an easy pose, far ones, tilts, image corners.

The optimum assumes that noise is all there is; a warped board, blur or a lens that its model does not quite
describe show only where boards differ. Not here: the figures of a finished set (`diversity`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np

from service.core.planning.pose_space import Mask, Poses, PoseSpace
from service.core.vision.target import Target
from service.core.vision.transforms import Array

# A board turned by no more than this is one that anyone can hit at the first try.
EASY_TURN_RAD: Final = float(np.deg2rad(20.0))
# A distance range counts as near and far from this ratio on; then this share of the poses is in its far half.
DISTINCT_RATIO: Final = 1.2
FAR_SHARE: Final = 0.25
TILTED: Final = float(np.sin(np.deg2rad(12.0)))
# Of the candidates, those nearest to an image corner; a set of fewer poses cannot visit every corner.
CORNER_SHARE: Final = 0.06
FEWEST_FOR_ALL: Final = 6


@dataclass(frozen=True)
class Requirement:
    """At least so many poses of a set are among some of the candidates: a mask (m,)."""

    mask: Mask
    least: int = 1

    def missing(self, chosen: Sequence[int]) -> int:
        """Return how many poses are missing."""
        return max(0, self.least - int(np.count_nonzero(self.mask[list(chosen)])))


def fixed_places(poses: Poses, target: Target, space: PoseSpace, count: int) -> list[Mask]:
    """Return which candidates (m,) may take the first places of a set: one easy pose, then some far ones.

    On paper every board is best as near as it may come; the camera works over the whole range. A range that
    is too narrow for near and far asks for nothing.
    """
    near, far = space.distance_m
    easy = poses.turns() <= EASY_TURN_RAD
    distant = np.linalg.norm(poses.centres(target), axis=1) >= (near + far) / 2.0
    places = [easy if np.any(easy) else np.ones(len(poses), bool)]
    if far > DISTINCT_RATIO * near and np.count_nonzero(distant) >= count:
        places += [distant] * int(FAR_SHARE * count)
    return places


def requirements(
    poses: Poses,
    image_points: Array,
    outer: Sequence[int],
    image_size: tuple[int, int],
    count: int,
) -> list[Requirement]:
    """Return what a set of `count` must hold as well: boards in every image corner, tilts of every sign.

    image_points: (m, n, 2) px; outer: which of them are the outermost. What no candidate offers is not asked
    for, nor anything of a very small set.
    """
    if count < FEWEST_FOR_ALL:
        return []
    right, bottom = image_size[0] - 1.0, image_size[1] - 1.0
    near_corners = []
    outline = image_points[:, list(outer)]
    for corner in product((0.0, right), (0.0, bottom)):
        reach = np.linalg.norm(outline - np.array(corner), axis=2).min(axis=1)
        near_corners.append(reach <= np.quantile(reach, CORNER_SHARE))
    tilts = [sign * poses.rotations[:, axis, 2] >= TILTED for axis in (0, 1) for sign in (1.0, -1.0)]
    return [Requirement(mask) for mask in (*near_corners, *tilts) if np.any(mask)]


def next_place(needed: Sequence[Requirement], chosen: Sequence[int]) -> Mask | None:
    """Return which candidates (m,) may take one more place so that a set misses less; None if all is met."""
    return next((one.mask for one in needed if one.missing(chosen) > 0), None)
