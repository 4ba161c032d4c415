"""Lens models that distort the ideal image plane z = 1: all that follows from a distortion function.

They end before 90 degrees from the axis, where that plane ends. Not here: a distortion (`lens_*`).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array

NEAREST_M = 1e-9
ITERATIONS = 12
SMALL_STEP = 1e-7
BISECTIONS = 24
FARTHEST = 12.0  # ideal radius, 85 degrees
CLEARLY = 8.0  # times as far beyond the fold as its tangential part may move it


@dataclass(frozen=True)
class PerspectiveLens:
    """A lens by its distortion of ideal coordinates x = X/Z, y = Y/Z.

    distort: from (..., 2) and coefficients to (..., 2). distort_with_jacobians: the same with derivatives by
    the ideal coordinates (2, 2, ...) and by the coefficients (2, c, ...). reach_of: from coefficients (c,) to
    the ideal radius up to which the distorted radius grows, inf where it always does.
    """

    name: str
    coefficients: tuple[str, ...]
    distort: Callable[[Array, Array], Array]
    distort_with_jacobians: Callable[[Array, Array], tuple[Array, Array, Array]]
    reach_of: Callable[[Array], float]
    weak: tuple[str, ...] = ()
    sweep_hfov_deg: tuple[float, ...] = (40.0, 60.0, 90.0, 120.0)

    def project(self, points: Array, k: Array) -> Array:
        """Return image coordinates (..., 2) of points (..., 3); NaN behind or beside the camera."""
        z = points[..., 2:3]
        seen = z > NEAREST_M
        return self.distort(np.where(seen, points[..., :2], np.nan) / np.where(seen, z, 1.0), k)

    def project_with_jacobians(self, points: Array, k: Array) -> tuple[Array, Array, Array]:
        """Return image coordinates (..., 2), derivatives by points (2, 3, ...) and by k (2, c, ...)."""
        inverse_z = 1.0 / points[..., 2]
        ideal = points[..., :2] * inverse_z[..., None]
        distorted, by_ideal, by_k = self.distort_with_jacobians(ideal, k)
        by_points = np.empty((2, 3, *inverse_z.shape))
        np.multiply(by_ideal, inverse_z, out=by_points[:, :2])
        by_points[:, 2] = -(by_points[:, 0] * ideal[..., 0] + by_points[:, 1] * ideal[..., 1])
        return distorted, by_points, by_k

    def unproject(self, image: Array, k: Array) -> Array:
        """Return directions (..., 3) with z = 1 of image coordinates (..., 2); NaN beyond the reach.

        Newton's method on the lens's own Jacobian, which converges in the image corner where a fixed-point
        iteration of five steps (OpenCV's default) is up to a pixel off.
        """
        limit = self.reach_of(k)
        # No direction leads there: the iterations would go on to their last for nothing.
        image = np.where(self._is_beyond(image, k, limit)[..., None], np.nan, image)
        ideal, good = self._newton(image, k, _inside(image, 0.99 * limit), limit)
        left = ~good & np.isfinite(image).all(axis=-1)
        if np.any(left):
            # Far from the image, as with a strongly bent quotient, Newton may leap about: begin near the end.
            start = self._bisected(image[left], k, limit)
            ideal[left], good[left] = self._newton(image[left], k, start, limit)
        rays = np.concatenate([ideal, np.ones_like(ideal[..., :1])], axis=-1)
        return np.where(good[..., None], rays, np.nan)

    def _is_beyond(self, image: Array, k: Array, limit: float) -> NDArray[np.bool_]:
        """Return which image points (...) are clearly beyond the image of the fold.

        On the fold, opposite points have opposite radial parts and the same tangential one, whose share moves
        the image of the fold by about its square.
        """
        if limit > FARTHEST:
            return np.zeros(image.shape[:-1], dtype=np.bool_)
        radius = np.linalg.norm(image, axis=-1)
        # A little before it, as it may be a pole.
        fold = image * ((1.0 - 1e-6) * limit / np.maximum(radius, 1e-12))[..., None]
        here, opposite = self.distort(fold, k), self.distort(-fold, k)
        across = np.linalg.norm(here - opposite, axis=-1)
        share = np.linalg.norm(here + opposite, axis=-1) / np.maximum(across, 1e-12)
        return np.asarray(radius > np.linalg.norm(here, axis=-1) * (1.0 + 1e-9 + CLEARLY * share**2))

    def _newton(self, image: Array, k: Array, ideal: Array, limit: float) -> tuple[Array, NDArray[np.bool_]]:
        """Return ideal coordinates (..., 2) from a start, and whether they give the image (...)."""
        for _ in range(ITERATIONS):
            distorted, by_ideal, _ = self.distort_with_jacobians(ideal, k)
            step = _solve_2x2(by_ideal, image - distorted)
            ideal = _before_fold(ideal, step, limit)
            # What a step leaves is about its square.
            if not np.any(np.abs(step) > SMALL_STEP):
                break
        return ideal, np.asarray(np.linalg.norm(image - self.distort(ideal, k), axis=-1) < 1e-9)

    def _bisected(self, image: Array, k: Array, limit: float) -> Array:
        """Return points (..., 2) along the image's own directions whose distorted radius is the image's."""
        wanted = np.linalg.norm(image, axis=-1, keepdims=True)
        along = image / np.maximum(wanted, 1e-12)
        low, high = np.zeros_like(wanted), np.full_like(wanted, min(limit, FARTHEST))
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            beyond = np.linalg.norm(self.distort(middle * along, k), axis=-1, keepdims=True) > wanted
            low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
        return np.asarray(0.5 * (low + high) * along)

    def radius(self, points: Array) -> Array:
        """Return the ideal radius √(X² + Y²)/Z of points (..., 3), inf where Z is not positive."""
        z = points[..., 2]
        across = np.sqrt(points[..., 0] ** 2 + points[..., 1] ** 2)
        return np.where(z > 0, across / np.where(z > 0, z, 1.0), np.where(np.isnan(z), np.nan, np.inf))

    def reach(self, k: Array) -> float:
        """Return the ideal radius up to which the distorted radius grows, inf where it always does."""
        return self.reach_of(k)


def _inside(points: Array, radius: float) -> Array:
    """Pull points (..., 2) back to a radius."""
    length = np.linalg.norm(points, axis=-1, keepdims=True)
    inside: Array = points * np.minimum(1.0, radius / np.maximum(length, 1e-12))
    return inside


def _before_fold(points: Array, step: Array, limit: float) -> Array:
    """Return points (..., 2) after a step, or half-way to the fold where the step leads beyond it.

    At the fold itself the Jacobian is singular, and an iteration that is put there stays there.
    """
    moved = points + step
    length = np.linalg.norm(moved, axis=-1, keepdims=True)
    beyond = length >= limit
    if not np.any(beyond):
        return moved
    halfway = 0.5 * (np.linalg.norm(points, axis=-1, keepdims=True) + limit)
    return np.where(beyond, moved * (halfway / np.maximum(length, 1e-12)), moved)


def _solve_2x2(matrix: Array, right: Array) -> Array:
    """Solve systems (2, 2, ...) for (..., 2) by Cramer's rule; singular ones give a zero step."""
    (a, b), (c, d) = matrix
    determinant = a * d - b * c
    safe = np.where(np.abs(determinant) < 1e-12, np.inf, determinant)
    x = (d * right[..., 0] - b * right[..., 1]) / safe
    y = (a * right[..., 1] - c * right[..., 0]) / safe
    return np.stack([x, y], axis=-1)
