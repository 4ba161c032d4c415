"""A virtual vehicle of a SKU: a camera within its tolerance, and its pictures at the prescribed poses."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import Intrinsics
from service.core.vision.target import parse_target
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Pose
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from service.simulator.vehicle import Mismatch, take_captures

# A hand that sees the ghost of the board on its screen, as a guided operator does.
HAND = Mismatch(position_m=0.002, angle_rad=math.radians(0.7))


def draw_vehicle(sku: Mapping[str, Any], rng: np.random.Generator) -> Intrinsics:
    """Return the true intrinsics of one camera of a SKU document."""
    return draw_camera(nominal_camera(sku), Tolerance(), rng)


def nominal_camera(sku: Mapping[str, Any]) -> Intrinsics:
    """Return the intrinsics that a SKU document promises."""
    width, height = sku["image_size"]
    return Intrinsics.from_parameters(sku["lens"], sku["nominal"], (width, height))


def photograph(
    camera: Intrinsics, sku: Mapping[str, Any], poses: Sequence[Mapping[str, Any]], seed: int
) -> Iterator[NDArray[np.uint8]]:
    """Yield the picture (h, w) that a hand takes at each prescribed pose, each a little off it."""
    prepared = prepare(production_scene(camera, parse_target(sku["target"]), seed))
    rng = np.random.default_rng(seed)
    for pose in poses:
        wanted = Pose(np.array(pose["rvec"]), np.array(pose["tvec"]))
        for capture in take_captures(prepared, [wanted], HAND, rng):
            yield capture.image
