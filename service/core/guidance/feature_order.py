"""In which of its two orders a target that looks the same turned by half is compared with a wanted pose.

The nearer one, so that no pose is out of reach. Where a board lies across, either is as near: there the order
stays as it was in the frame before, or hints would turn to and fro.
"""

from dataclasses import replace
from typing import Final

import numpy as np

from service.core.guidance.observation import Observation
from service.core.vision.half_turn import turn_by_half
from service.core.vision.target import Target
from service.core.vision.transforms import Pose

# Cosine of the turn in the plane of the board up to which an order is kept: 105 degrees off the wanted pose.
KEPT: Final = float(np.cos(np.deg2rad(105.0)))


def in_order_of(expected: Pose, now: Observation, before: Observation | None, target: Target) -> Observation:
    """Return what a frame showed, in the order in which it is near to the expected pose."""
    if not target.is_symmetric or now.pose is None or now.image_points is None:
        return now
    agrees = _agreement(expected, now.pose)
    is_turned = agrees < 0.0
    if before is not None and before.pose is not None and abs(agrees) < abs(KEPT):
        is_turned = _agreement(before.pose, now.pose) < 0.0
    if not is_turned:
        return now
    return replace(now, pose=turn_by_half(now.pose, target), image_points=now.image_points[::-1])


def _agreement(one: Pose, other: Pose) -> float:
    """Return about the cosine of the turn between two poses in the board's plane."""
    return float(np.sum(one.rotation[:, :2] * other.rotation[:, :2]) / 2.0)
