"""The ray of every pixel: the lens's distortion, undone once for a camera. Not here: what a ray meets."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RectBivariateSpline

from service.core.vision.camera import LENSES, Intrinsics, undistort
from service.core.vision.transforms import Array

NODE_STEP_PX = 16
EXACT = 1e-11  # residual in the ideal plane: a hundred-millionth of a pixel


@dataclass(frozen=True)
class RayMap:
    """What a camera's pixels look along.

    ideal: (2, h, w) ideal image-plane coordinates x and y, one plane each; NaN where the lens does not reach.
    spread: (h, w), a bound on how far a pixel's footprint reaches from its centre in the ideal plane.
    """

    intrinsics: Intrinsics
    ideal: Array
    spread: Array

    def jacobian(self, ideal: Array) -> Array:
        """Return d(ideal)/d(pixel) (n, 2, 2) at ideal coordinates (n, 2)."""
        return _pixel_jacobian(self.intrinsics, ideal)


def trace_rays(intrinsics: Intrinsics) -> RayMap:
    """Return the ray map of a camera, exact at every pixel to about the rounding of float64.

    Inverting the lens at every 16th pixel and interpolating gives a start from which one Newton step is
    exact; pixels where it is not (where the lens folds) are inverted one by one.
    """
    columns, rows = (np.arange(size, dtype=np.float64) for size in intrinsics.image_size)
    nodes_x, nodes_y = _nodes(columns), _nodes(rows)
    nodes = np.nan_to_num(undistort(intrinsics, _grid(nodes_x, nodes_y)))
    splines = [RectBivariateSpline(nodes_y, nodes_x, nodes[..., axis], kx=3, ky=3) for axis in range(2)]
    bands = [
        _rays_of(
            intrinsics, _grid(columns, band), np.stack([spline(band, columns) for spline in splines], axis=-1)
        )
        for band in np.array_split(rows, max(1, len(rows) // NODE_STEP_PX))
    ]
    ideal = np.ascontiguousarray(np.moveaxis(np.concatenate(bands), -1, 0))
    return RayMap(intrinsics, ideal, np.concatenate([_spread(intrinsics, band) for band in bands]))


def _spread(intrinsics: Intrinsics, ideal: Array) -> Array:
    jacobian = _pixel_jacobian(intrinsics, ideal)
    spread: Array = 0.5 * np.sqrt(np.sum(jacobian * jacobian, axis=-2)).sum(axis=-1)
    return spread


def _rays_of(intrinsics: Intrinsics, pixels: Array, start: Array) -> Array:
    """Return the ideal coordinates (..., 2) of pixels (..., 2) from a close start."""
    ideal = start + _newton_step(intrinsics, start, pixels)
    vector = intrinsics.vector
    distorted = LENSES[intrinsics.lens].distort(ideal, vector[4:])
    off = np.abs(distorted - (pixels - vector[2:4]) / vector[:2]).max(axis=-1)
    astray = ~(off < EXACT)
    ideal[astray] = undistort(intrinsics, pixels[astray])
    return ideal


def _newton_step(intrinsics: Intrinsics, start: Array, pixels: Array) -> Array:
    vector = intrinsics.vector
    seen = LENSES[intrinsics.lens].distort(start, vector[4:]) * vector[:2] + vector[2:4]
    step: Array = np.einsum("...ij,...j->...i", _pixel_jacobian(intrinsics, start), pixels - seen)
    return step


def _pixel_jacobian(intrinsics: Intrinsics, ideal: Array) -> Array:
    """Return d(ideal)/d(pixel) (..., 2, 2): the inverse of the projection's, by Cramer's rule."""
    vector = intrinsics.vector
    by_xy, _ = LENSES[intrinsics.lens].distort_jacobians(ideal, vector[4:])
    (a, b), (c, d) = np.moveaxis(by_xy * vector[:2, None], (-2, -1), (0, 1))
    determinant = a * d - b * c
    scale = 1.0 / np.where(np.abs(determinant) < 1e-9, np.nan, determinant)
    return (
        np.stack([np.stack([d, -b], axis=-1), np.stack([-c, a], axis=-1)], axis=-2) * scale[..., None, None]
    )


def _nodes(positions: Array) -> Array:
    return np.linspace(positions[0], positions[-1], len(positions) // NODE_STEP_PX + 4)


def _grid(columns: Array, rows: Array) -> Array:
    return np.stack(np.meshgrid(columns, rows), axis=-1)
