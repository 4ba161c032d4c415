"""A pose set over the image, cell by cell: where its boards and corners are.

Not here: what mapping it promises (`service.core.vision.error_maps`).
"""

from dataclasses import dataclass

import numpy as np

from service.core.planning.pose_space import Poses
from service.core.vision.camera import Intrinsics, project, unproject
from service.core.vision.feature_grid import extent
from service.core.vision.image_grid import Counts, ImageGrid
from service.core.vision.target import Target


@dataclass(frozen=True)
class Coverage:
    """corners: (rows, columns) corners of all poses in each cell. boards: those whose corners enclose it."""

    corners: Counts
    boards: Counts


def measure_coverage(intrinsics: Intrinsics, target: Target, poses: Poses, grid: ImageGrid) -> Coverage:
    """Return where the corners and boards of m poses are in the image."""
    pixels = project(intrinsics, poses.rotations, poses.translations, target.object_points)
    rays = unproject(intrinsics, grid.centres)
    # Columns are the board's axes and its origin: the inverse takes a ray to the board's own coordinates.
    plane = np.concatenate([poses.rotations[:, :, :2], poses.translations[:, :, None]], axis=-1)
    place = np.linalg.inv(plane) @ rays.T
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y = place[:, 0] / place[:, 2], place[:, 1] / place[:, 2]
    size = np.subtract(*extent(target.object_points)[::-1])
    # Written so that NaN, where the lens does not reach, is outside.
    inside = (place[:, 2] > 0) & (x >= 0) & (x <= size[0]) & (y >= 0) & (y <= size[1])
    boards = inside.sum(axis=0).reshape(grid.rows, grid.columns)
    return Coverage(grid.count(pixels), boards.astype(np.int64))
