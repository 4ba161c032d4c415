"""Pixels around features, as arrays, and the least-squares steps of a model that is fitted to each patch.

Not here: models (`edge_crossing`, `dot_rims`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.sampling import FloatImage
from service.core.vision.transforms import Array

RIDGE = 1e-9  # of the largest diagonal, so that what a patch does not tell stays as it is


@dataclass(frozen=True)
class Patches:
    """Pixels around each of n features: places x, y (n, k) px, grey levels (n, k), and which are inside."""

    x: Array
    y: Array
    levels: Array
    inside: NDArray[np.bool_]

    def ways_from(self, points: Array) -> tuple[Array, Array]:
        """Return the ways (n, k) px, along x and y, to the pixels from points (n, 2)."""
        return self.x - points[:, :1], self.y - points[:, 1:2]


def cut_patches(image: FloatImage, middles: Array, reach_px: float) -> Patches:
    """Return the pixels of an image (h, w) in discs around middles (n, 2) px."""
    height, width = image.shape
    reach = int(np.ceil(reach_px))
    dy, dx = (offsets.ravel() for offsets in np.mgrid[-reach : reach + 1, -reach : reach + 1])
    disc = dx * dx + dy * dy <= (reach + 0.5) ** 2
    middle = np.rint(middles).astype(np.int64)
    x, y = middle[:, :1] + dx[disc], middle[:, 1:] + dy[disc]
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    levels = image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)]
    return Patches(x.astype(np.float64), y.astype(np.float64), levels.astype(np.float64), inside)


def soft_step(depth_px: Array, width_px: float) -> Array:
    """Return weights from 0 to 1 of pixels so deep inside a border.

    With a hard border pixels would jump in and out as it moves.
    """
    return np.clip(depth_px / width_px + 0.5, 0.0, 1.0)


def solve_steps(J: Array, weights: Array, error: Array) -> Array:
    """Return Gauss and Newton's steps (n, p) from derivatives (n, p, k), weights and errors (n, k)."""
    weighted = J * weights[:, None]
    information = weighted @ np.swapaxes(J, -1, -2)
    diagonal = np.einsum("nii->ni", information)
    diagonal += RIDGE * diagonal.max(axis=1, keepdims=True)
    steps = np.linalg.solve(information, weighted @ error[..., None])[..., 0]
    return np.asarray(steps, dtype=np.float64)
