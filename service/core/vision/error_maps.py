"""Errors over the image, cell by cell: what a covariance promises, and what the corners left over.

Not here: figures over a whole zone (`uncertainty`), two cameras (`camera_comparison`).
"""

from dataclasses import dataclass

import numpy as np

from service.core.vision.camera import Intrinsics, project_with_jacobians, unproject
from service.core.vision.image_grid import Counts, ImageGrid
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region, compensated_jacobian


@dataclass(frozen=True)
class PredictedMap:
    """Expected sd of the mapping at each cell's centre: sd_px and sd_mdeg (rows, columns).

    NaN where the lens does not reach. As in MappingError, it is the length of the two components together.
    """

    sd_px: Array
    sd_mdeg: Array


@dataclass(frozen=True)
class ResidualMap:
    """rms_px (rows, columns): √(mean |e|²) of the corners in each cell, NaN without any; their corners."""

    rms_px: Array
    corners: Counts


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


def measure_residuals(image_points: Array, residuals: Array, grid: ImageGrid) -> ResidualMap:
    """Return what corners (n, 2) px with residuals (n, 2) px leave over in each cell.

    Few corners are no judgement: one corner's residual is as likely twice the noise as half of it.
    """
    corners = grid.count(image_points)
    squares = grid.total(image_points, np.sum(residuals**2, axis=-1))
    return ResidualMap(np.sqrt(squares / np.where(corners > 0, corners, np.nan)), corners)


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
