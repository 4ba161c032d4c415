"""The ray of every pixel: the lens's distortion, undone once for a camera. Not here: what a ray meets."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RectBivariateSpline

from service.core.vision.camera import LENSES, Intrinsics, unproject
from service.core.vision.transforms import Array

NODE_STEP_PX = 16
EXACT = 1e-11  # residual at focal length one: a hundred-millionth of a pixel


@dataclass(frozen=True)
class RayMap:
    """What a camera's pixels look along.

    directions: (3, h, w) in the camera frame, of the lens's own length, one plane for each component; NaN
    where the lens does not reach. spread: (h, w), a bound on how far a direction moves from a pixel's centre
    to the farthest of its footprint, across itself.
    """

    intrinsics: Intrinsics
    directions: Array
    spread: Array

    def jacobian(self, directions: Array) -> Array:
        """Return d(direction)/d(pixel) (n, 3, 2) at directions (n, 3), across themselves."""
        _, by_pixel = _image_and_inverse(self.intrinsics, directions)
        return by_pixel


def trace_rays(intrinsics: Intrinsics) -> RayMap:
    """Return the ray map of a camera, exact at every pixel to about the rounding of float64.

    Inverting the lens at every 16th pixel and interpolating gives a start from which one Newton step is
    exact; pixels where it is not (where the lens folds) are inverted one by one.
    """
    columns, rows = (np.arange(size, dtype=np.float64) for size in intrinsics.image_size)
    nodes_x, nodes_y = _nodes(columns), _nodes(rows)
    found = unproject(intrinsics, _grid(nodes_x, nodes_y))
    nodes = np.where(np.isfinite(found), found, np.array([0.0, 0.0, 1.0]))
    splines = [RectBivariateSpline(nodes_y, nodes_x, nodes[..., axis], kx=3, ky=3) for axis in range(3)]
    directions = np.empty((3, len(rows), len(columns)))
    spread = np.empty((len(rows), len(columns)))
    for band in np.array_split(np.arange(len(rows)), max(1, len(rows) // NODE_STEP_PX)):
        pixels = _grid(columns, rows[band])
        start = np.stack([spline(rows[band], columns) for spline in splines], axis=-1)
        found = _rays_of(intrinsics, pixels, start)
        directions[:, band] = np.moveaxis(found, -1, 0)
        spread[band] = _spread(intrinsics, found)
    return RayMap(intrinsics, directions, spread)


def _spread(intrinsics: Intrinsics, directions: Array) -> Array:
    _, by_pixel = _image_and_inverse(intrinsics, directions)
    spread: Array = 0.5 * np.sqrt(np.sum(by_pixel * by_pixel, axis=-2)).sum(axis=-1)
    return spread


def _rays_of(intrinsics: Intrinsics, pixels: Array, start: Array) -> Array:
    """Return the directions (..., 3) of pixels (..., 2) from a close start."""
    seen, by_pixel = _image_and_inverse(intrinsics, start)
    directions = start + np.einsum("...ij,...j->...i", by_pixel, pixels - seen)
    vector = intrinsics.vector
    image = LENSES[intrinsics.lens].project(directions, vector[4:])
    off = np.abs(image - (pixels - vector[2:4]) / vector[:2]).max(axis=-1)
    astray = ~(off < EXACT)
    directions[astray] = unproject(intrinsics, pixels[astray])
    return np.asarray(directions, dtype=np.float64)


def _image_and_inverse(intrinsics: Intrinsics, directions: Array) -> tuple[Array, Array]:
    """Return the pixels (..., 2) of directions (..., 3), and how those move with the pixels (..., 3, 2).

    The projection's Jacobian P (2, 3) takes a direction itself to zero, so that its pseudo-inverse
    Pᵀ(PPᵀ)⁻¹ is the inverse across the direction.
    """
    vector = intrinsics.vector
    image, by_point, _ = LENSES[intrinsics.lens].project_with_jacobians(directions, vector[4:])
    u, v = by_point[0] * vector[0], by_point[1] * vector[1]
    uu, vv, uv = (np.sum(a * b, axis=0) for a, b in ((u, u), (v, v), (u, v)))
    determinant = uu * vv - uv * uv
    scale = 1.0 / np.where(determinant > 1e-18 * uu * vv, determinant, np.nan)
    by_pixel = np.stack([u * (vv * scale) - v * (uv * scale), v * (uu * scale) - u * (uv * scale)], axis=-1)
    return image * vector[:2] + vector[2:4], np.moveaxis(by_pixel, 0, -2)


def _nodes(positions: Array) -> Array:
    return np.linspace(positions[0], positions[-1], len(positions) // NODE_STEP_PX + 4)


def _grid(columns: Array, rows: Array) -> Array:
    return np.stack(np.meshgrid(columns, rows), axis=-1)
