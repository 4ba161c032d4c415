"""A pose set over the image, cell by cell: where its boards and corners are, and what mapping it promises.

Not here: figures over a whole zone (`service.core.vision.uncertainty`).
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from service.core.planning.pose_space import Poses
from service.core.vision.camera import Intrinsics, project, project_with_jacobians, unproject
from service.core.vision.feature_grid import extent
from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region, compensated_jacobian

COLUMNS: Final = 40
Counts = NDArray[np.int64]


@dataclass(frozen=True)
class ImageGrid:
    """The image (width, height) px cut into cells as square as `columns` allows; row by row."""

    image_size: tuple[int, int]
    columns: int = COLUMNS

    @property
    def rows(self) -> int:
        """How many rows of cells there are."""
        width, height = self.image_size
        return max(1, round(self.columns * height / width))

    @property
    def centres(self) -> Array:
        """The cells' centres (rows * columns, 2), px; the image begins half a pixel before pixel 0."""
        width, height = self.image_size
        u, v = width / self.columns, height / self.rows
        return Region(u / 2 - 0.5, v / 2 - 0.5, width - 0.5 - u / 2, height - 0.5 - v / 2).grid(
            self.columns, self.rows
        )

    def count(self, image_points: Array) -> Counts:
        """Return how many points (..., 2) px fall into each cell: (rows, columns)."""
        width, height = self.image_size
        u, v = image_points.reshape(-1, 2).T
        bounds = ((-0.5, height - 0.5), (-0.5, width - 0.5))
        counts, _, _ = np.histogram2d(v, u, bins=(self.rows, self.columns), range=bounds)
        return counts.astype(np.int64)


@dataclass(frozen=True)
class Coverage:
    """corners: (rows, columns) corners of all poses in each cell. boards: those whose corners enclose it."""

    corners: Counts
    boards: Counts


@dataclass(frozen=True)
class PredictedMap:
    """Expected sd of the mapping at each cell's centre: sd_px and sd_mdeg (rows, columns).

    NaN where the lens does not reach. As in MappingError, it is the length of the two components together.
    """

    sd_px: Array
    sd_mdeg: Array


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


def predict_map(intrinsics: Intrinsics, covariance: Array, grid: ImageGrid, zone: Region) -> PredictedMap:
    """Return the mapping error that a covariance (p, p) of the parameters promises over the image.

    The rotation that fits the zone best is taken out, as in the figures of that zone. An error in px becomes
    the smallest turn of its ray that moves the pixel as far: ω = B⁺ d with B = ∂pixel/∂ω (2, 3).
    """
    J = compensated_jacobian(intrinsics, grid.centres, zone)
    shape = (grid.rows, grid.columns)
    by_turn = np.linalg.pinv(_finite(_turn_jacobian(intrinsics, grid.centres)))
    turned = by_turn @ J
    return PredictedMap(
        np.sqrt(_variance(J, covariance)).reshape(shape),
        1e3 * np.rad2deg(np.sqrt(_variance(turned, covariance))).reshape(shape),
    )


def _variance(J: Array, covariance: Array) -> Array:
    """Return tr(J Σ Jᵀ) (m,) of Jacobians (m, k, p)."""
    variance: Array = np.einsum("mif,fg,mig->m", J, covariance, J)
    return variance


def _turn_jacobian(intrinsics: Intrinsics, pixels: Array) -> Array:
    """Return how pixels (m, 2) move with a turn of the camera: (m, 2, 3) px/rad, NaN beyond the lens."""
    _, _, by_pose = project_with_jacobians(
        intrinsics.lens,
        intrinsics.vector,
        np.eye(3)[None],
        np.zeros((1, 3)),
        unproject(intrinsics, pixels),
    )
    turned: Array = by_pose[0, ..., :3]
    return turned


def _finite(J: Array) -> Array:
    """Return Jacobians that can be inverted; those of NaN are multiplied with NaN afterwards anyway."""
    return np.where(np.isfinite(J), J, 0.0)
