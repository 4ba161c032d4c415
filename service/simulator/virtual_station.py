"""The virtual vehicle that a virtual station shows: everything about it follows from its serial.

The same serial is the same camera, so that a run that is resumed goes on with the same vehicle. Not here:
frames (`frame_source`), and how fast anybody pulls them.
"""

import hashlib
from collections.abc import Callable

import numpy as np

from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.tolerance import Tolerance, draw_camera
from service.ports import BoardMove
from service.simulator.frame_source import VirtualSource, make_virtual_source
from service.simulator.held_board import HeldBoard
from service.simulator.operator import Hand
from service.simulator.scene import production_scene


def camera_of_serial(nominal: Intrinsics, serial: str) -> Intrinsics:
    """Return the true camera of a virtual vehicle: within the tolerance of its SKU's nominal one."""
    return draw_camera(nominal, Tolerance(), _rng(serial))


def source_of_serial(nominal: Intrinsics, target: Target, serial: str) -> VirtualSource:
    """Return the live camera of a virtual vehicle, with a hand before it; takes a second or two."""
    scene = production_scene(camera_of_serial(nominal, serial), target)
    return make_virtual_source(scene, Hand(target), _rng(f"{serial} hand"))


def held_source_of_serial(
    nominal: Intrinsics, target: Target, serial: str, take_move: Callable[[], BoardMove | None]
) -> VirtualSource:
    """Return the live camera of a virtual vehicle, with a board before it that a person moves."""
    camera = camera_of_serial(nominal, serial)
    scene = production_scene(camera, target)
    return make_virtual_source(scene, HeldBoard(camera, target, take_move), _rng(f"{serial} held"))


def _rng(words: str) -> np.random.Generator:
    digest = hashlib.sha256(words.encode("utf-8", "surrogatepass")).digest()
    return np.random.default_rng(int.from_bytes(digest[:8], "little"))
