"""Room that a fixture leaves: boxes in the camera frame that no part of the plate may touch.

Not here: the other bounds of a pose (`pose_space`).
"""

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array

# A plate ends about so far beyond what is printed dark on it.
PLATE_MARGIN_SQUARES = 0.6


@dataclass(frozen=True)
class Box:
    """A box with sides along the camera's axes (x right, y down, z away): two opposite corners, m."""

    low_m: tuple[float, float, float]
    high_m: tuple[float, float, float]


def plate_corners(target: Target) -> Array:
    """Return the four corners (4, 3), m, of the plate in the board frame: tl, tr, br, bl."""
    outwards = np.array([(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)])
    plate: Array = target.outline + PLATE_MARGIN_SQUARES * target.square_m * outwards
    return plate


def touches_a_box(
    boxes: tuple[Box, ...], target: Target, rotations: Array, translations: Array
) -> NDArray[np.bool_]:
    """Return which plates (m,), at poses (m, 3, 3), (m, 3), touch any of the boxes."""
    touching = np.zeros(len(translations), dtype=bool)
    plates = plate_corners(target) @ np.swapaxes(rotations, 1, 2) + translations[:, None]
    for box in boxes:
        touching |= _touches(
            np.array(list(product(*zip(box.low_m, box.high_m, strict=True)))), plates, rotations
        )
    return touching


def _touches(box: Array, plates: Array, rotations: Array) -> NDArray[np.bool_]:
    """Return which plates (m, 4, 3) touch a box (8, 3).

    Two convex bodies are apart where some axis parts them. The axes are the normals of the box's faces and of
    the plate, and the cross products of their edges (Gottschalk, 1996).
    """
    faces = np.broadcast_to(np.eye(3), (len(plates), 3, 3))
    edges = np.swapaxes(rotations, 1, 2)[:, :2]
    crossed = np.cross(edges[:, :, None], np.eye(3)[None, None]).reshape(len(plates), 6, 3)
    axes = np.concatenate([faces, np.swapaxes(rotations, 1, 2)[:, 2:], crossed], axis=1)
    along_box = axes @ box.T
    along_plate = axes @ np.swapaxes(plates, 1, 2)
    apart = (along_plate.min(axis=2) > along_box.max(axis=2)) | (
        along_plate.max(axis=2) < along_box.min(axis=2)
    )
    touching: NDArray[np.bool_] = ~apart.any(axis=1)
    return touching
