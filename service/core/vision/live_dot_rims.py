"""Where exactly dots of a live frame are, and how bright and sharp their rims look.

Not here: which dots they are (`live_circles`); what is measured on a capture (`circle_centres`, `sharpness`).
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from service.core.vision.light import LightFall
from service.core.vision.live_look import Look, look_along_edges
from service.core.vision.radial_map import fit_radial_map
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array

REACH: Final = 1.5  # of a dot's radius: what its centroid is of, where the gap has room for it
GAP_SHARE: Final = 0.45  # of the way to the next dot's rim
RADIAL_TERMS: Final = 1  # enough for axes
LARGEST_WINDOW_PX: Final = 9  # beyond it the centroid of whole pixels is as good
ANGLES: Final = np.arange(8) * (np.pi / 4.0)
RIM: Final = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=-1)


def rim_axes(points: Array, target: Circles, middle: Array) -> Array:
    """Return the images (n, 2, 2), px, of dots' radii along the board's x (first column) and y.

    middle: (2,) px, of the frame.
    """
    board = target.object_points[:, :2]
    board_map = fit_radial_map(board, points, middle, RADIAL_TERMS)
    centres = board_map.image_of(board)
    sides = [board_map.image_of(board + side) - centres for side in 0.5 * target.diameter_m * np.eye(2)]
    return np.stack(sides, axis=-1)


def refine_dots(
    half: NDArray[np.uint8], light: LightFall, points: Array, axes: Array, target: Circles
) -> Array:
    """Return the centroids (n, 2), px, of the darkness around points (n, 2) that are right to a pixel."""
    reach = min(REACH, 1.0 + GAP_SHARE * _gap(target))
    longest = int(np.ceil(reach * np.linalg.norm(axes, axis=(1, 2)).max()))
    if longest > LARGEST_WINDOW_PX:
        return points
    window = np.mgrid[-longest : longest + 1, -longest : longest + 1].reshape(2, -1).T
    spots = np.rint(points).astype(np.int64)[:, None] + window
    x, y = np.clip(spots, 0, np.array(half.shape)[::-1] - 1).transpose(2, 0, 1)
    away = np.linalg.norm((spots - points[:, None]) @ np.linalg.inv(axes).swapaxes(1, 2), axis=-1)
    bright, dark = light.levels(x, y)
    weight = np.clip((bright - half[y, x]) / np.maximum(bright - dark, 1.0), 0.0, 1.0) * (away <= reach)
    total = np.maximum(weight.sum(axis=1), 1e-9)
    return np.asarray((weight[..., None] * spots).sum(axis=1) / total[:, None])


def measure_rims(half: NDArray[np.uint8], points: Array, axes: Array, target: Circles) -> Look:
    """Return how the rims of dots at points (n, 2) px look."""
    outwards = (axes @ RIM.T).swapaxes(1, 2)
    normal = (np.linalg.inv(axes).swapaxes(1, 2) @ RIM.T).swapaxes(1, 2)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    radius_px = np.sum(outwards * normal, axis=-1).ravel()
    middles = (points[:, None] + outwards).reshape(-1, 2)
    return look_along_edges(half, middles, normal.reshape(-1, 2), 2.0 * radius_px, _gap(target) * radius_px)


def _gap(target: Circles) -> float:
    """Return how far it is from a dot's rim to the next one's, in radii."""
    return float(np.sqrt(2.0) * target.step_m / (0.5 * target.diameter_m) - 2.0)
