"""How far pixels may be off: mapping error and mapping difference, compensated for a rotation of the camera.

Two intrinsics that differ by a rotation of the camera frame are the same camera seen from a turned frame, so
the best rotation is taken out first. K(a, b) = min over R of (1/N) Σ |x_i − p_b(R p_a⁻¹(x_i))|²; with b = a +
δ this is δᵀHδ, and for an estimate of covariance Σ its expectation is tr(HΣ) (Hagemann, Knorr, Janssen,
Stiller, IJCV 2022). Not here: limits on these values (`service.core.quality`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import (
    Intrinsics,
    are_reached,
    project_camera_points,
    project_with_jacobians,
    unproject,
)
from service.core.vision.transforms import Array, rotation_matrix

GRID = (12, 8)
ROTATION_STEPS = 8
SMALL_TURN_RAD = 5e-5  # its square moves a pixel by about 1e-6 px


@dataclass(frozen=True)
class Region:
    """A rectangle of the image, px, both edges included."""

    left_px: float
    top_px: float
    right_px: float
    bottom_px: float

    def grid(self, columns: int, rows: int) -> Array:
        """Return evenly spaced pixels (rows * columns, 2), row by row, corners of the region included."""
        u, v = (
            np.linspace(self.left_px, self.right_px, columns),
            np.linspace(self.top_px, self.bottom_px, rows),
        )
        return np.stack([np.tile(u, rows), np.repeat(v, columns)], axis=-1)


@dataclass(frozen=True)
class MappingError:
    """Expected error of a mapping, px: root of the mean and of the worst variance over a grid of pixels.

    Both are inf where the lens does not reach a pixel of the grid, for nothing can be promised there.
    """

    mean_px: float
    worst_px: float


def whole_image(image_size: tuple[int, int]) -> Region:
    """Return the region of an image (width, height), from its first pixel's centre to its last's."""
    return Region(0.0, 0.0, image_size[0] - 1.0, image_size[1] - 1.0)


def mapping_error(intrinsics: Intrinsics, covariance: Array, region: Region | Array) -> MappingError:
    """Return the expected mapping error, given a covariance (p, p), over a region or pixels (m, 2)."""
    grid = region.grid(*GRID) if isinstance(region, Region) else region
    J = compensated_jacobian(intrinsics, grid)
    variances = np.einsum("mif,fg,mig->m", J, covariance, J)
    if len(J) == 0 or not np.all(np.isfinite(variances)):
        return MappingError(float("inf"), float("inf"))
    return MappingError(float(np.sqrt(variances.mean())), float(np.sqrt(variances.max())))


def parameter_metric(intrinsics: Intrinsics, grid: Region | Array) -> Array:
    """Return H (p, p): δᵀHδ is the mean squared mapping difference, px², of a small change δ.

    grid: a region or pixels (m, 2). Pixels that the lens does not reach are left out.
    """
    pixels = grid.grid(*GRID) if isinstance(grid, Region) else grid
    J = compensated_jacobian(intrinsics, pixels)
    J = J[np.all(np.isfinite(J), axis=(1, 2))].reshape(-1, J.shape[-1])
    return 2.0 * (J.T @ J) / max(len(J), 1)


def compensated_jacobian(intrinsics: Intrinsics, grid: Array, held: Region | None = None) -> Array:
    """Return how pixels (m, 2) of fixed directions move with the parameters: (m, 2, p).

    The best rotation is taken out: of all pixels together, or of the region that is to be `held`. NaN for
    pixels that the lens does not reach.
    """
    reached, A, B = _jacobians(intrinsics, grid)
    fitted = (A, B) if held is None else _jacobians(intrinsics, held.grid(*GRID))[1:]
    p = A.shape[-1]
    turn = _best_turns(fitted[1].reshape(-1, 3), fitted[0].reshape(-1, p))
    out = np.full((len(grid), 2, p), np.nan)
    out[reached] = A - B @ turn
    return out


def _jacobians(intrinsics: Intrinsics, pixels: Array) -> tuple[NDArray[np.bool_], Array, Array]:
    """Return which pixels (m, 2) the lens reaches, and how those r move.

    By the parameters (r, 2, p), and by a turn of the camera (r, 2, 3).
    """
    rays = unproject(intrinsics, pixels)
    reached: NDArray[np.bool_] = np.all(np.isfinite(rays), axis=-1)
    _, by_parameters, by_pose = project_with_jacobians(
        intrinsics.lens, intrinsics.vector, np.eye(3)[None], np.zeros((1, 3)), rays[reached]
    )
    return reached, by_parameters[0], by_pose[0, ..., :3]


def mapping_difference(a: Intrinsics, b: Intrinsics, grid: Region | Array) -> Array:
    """Return the distances (m,) px between the pixels of a and where b sees them after the best rotation.

    grid: a region or pixels (m, 2) of a. NaN for pixels that a lens does not reach.
    """
    pixels = grid.grid(*GRID) if isinstance(grid, Region) else grid
    return _difference(b, unproject(a, pixels), pixels)


def difference_of_rays(a: Intrinsics, b: Intrinsics, rays: Array) -> Array:
    """Return the distances (m,) px between the images of rays (m, 3) in a and in b after the best rotation.

    NaN for those that a lens does not reach.
    """
    return _difference(b, rays, project_camera_points(a, rays))


def _difference(b: Intrinsics, rays: Array, pixels: Array) -> Array:
    """Return the distances (m,) px from pixels (m, 2) of rays (m, 3) in b after the best rotation."""
    reached = np.isfinite(pixels).all(axis=-1) & are_reached(b, rays)
    out = np.full(len(pixels), np.nan)
    if np.count_nonzero(reached) >= 2:
        _, left = best_turn(b, rays[reached], pixels[reached])
        out[reached] = np.linalg.norm(left, axis=-1)
    return out


def best_turn(b: Intrinsics, rays: Array, pixels: Array) -> tuple[Array, Array]:
    """Return the rotation (3, 3) of rays (m, 3) that brings b's projections nearest to pixels (m, 2).

    And the pixels minus those projections (m, 2), px (Gauss–Newton). b must reach all rays.
    """
    R = np.eye(3)
    difference = np.empty_like(pixels)
    for _ in range(ROTATION_STEPS):
        projected, _, by_pose = project_with_jacobians(b.lens, b.vector, R[None], np.zeros((1, 3)), rays)
        difference = pixels - projected[0]
        B = by_pose[0, ..., :3]
        turn = _best_turns(B.reshape(-1, 3), difference.reshape(-1))
        R = rotation_matrix(turn) @ R
        if np.abs(turn).max() < SMALL_TURN_RAD:
            # Of so small a turn the square is rounding: what is left follows without another look.
            return R, difference - B @ turn
    return R, difference


def _best_turns(B: Array, moved: Array) -> Array:
    """Return the turns (3, ...), rad, by which B (n, 3) explains most of how pixels moved (n, ...), px.

    By the normal equations, which are well conditioned, all turns moving pixels by about as much; but for the
    turn about a single pixel, which moves nothing.
    """
    try:
        return np.asarray(np.linalg.solve(B.T @ B, B.T @ moved))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(B.T @ B, hermitian=True) @ (B.T @ moved))
