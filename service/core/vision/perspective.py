"""Lens models that distort the ideal image plane z = 1: all that follows from a radial factor.

They end before 90 degrees from the axis, where that plane ends. Not here: such a factor (`lens_*`).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array

NEAREST_M = 1e-9
ITERATIONS = 12
SHORT_STEP, SMALL_STEP = 1e-2, 1e-7
MUCH_SHORTER = 0.05
GOOD = 1e-9  # what the last step of all may leave
FARTHEST = 12.0  # ideal radius, 85 degrees
TABLE = np.linspace(0.0, 0.9999, 257) ** 2  # dense about the axis, where most pixels are
TANGENTIAL = 3.0  # times |p1| + |p2| and the ideal radius squared: no image is moved farther by them
WELL_BEFORE = 0.9  # of the ideal radius of the fold: the tangential part does not move it so far
CLEARLY = 8.0  # times as far beyond the fold as its tangential part may move it


@dataclass(frozen=True)
class PerspectiveLens:
    """A lens by the factor that its radial distortion puts on ideal coordinates x = X/Z, y = Y/Z.

    Coefficients are in OpenCV's order: p1 and p2, the tangential ones, are the third and fourth. radial: the
    factor (...) of r² (...) and k. radial_with_jacobians: the same, twice its derivative by r², and those by
    the other coefficients in their order. reach_of: from coefficients (c,) to the ideal radius up to which
    the distorted radius grows, inf where it always does. grows_up_to: whether it grows up to an ideal radius,
    which may be told sooner than where it ends. of_division: as `Lens.like_division`.
    """

    name: str
    coefficients: tuple[str, ...]
    radial: Callable[[Array, Array], Array]
    radial_with_jacobians: Callable[[Array, Array], tuple[Array, Array, Sequence[Array]]]
    reach_of: Callable[[Array], float]
    grows_up_to: Callable[[Array, float], bool]
    of_division: Callable[[float], Array] | None = None
    weak: tuple[str, ...] = ()
    sweep_hfov_deg: tuple[float, ...] = (40.0, 60.0, 90.0, 120.0)

    def project(self, points: Array, k: Array) -> Array:
        """Return image coordinates (..., 2) of points (..., 3); NaN behind or beside the camera."""
        z = points[..., 2]
        if not z.min(initial=np.inf) > NEAREST_M:
            z = np.where(z > NEAREST_M, z, np.nan)
        return np.stack(self._image(points[..., 0] / z, points[..., 1] / z, k), axis=-1)

    def project_with_jacobians(self, points: Array, k: Array) -> tuple[Array, Array, Array]:
        """Return image coordinates (..., 2), derivatives by points (2, 3, ...) and by k (2, c, ...)."""
        inverse_z = 1.0 / points[..., 2]
        x, y = points[..., 0] * inverse_z, points[..., 1] * inverse_z
        image, (xx, xy, yy), by_k = self._linearised(x, y, k)
        by_points = np.empty((2, 3, *x.shape))
        by_points[0, 0] = xx = xx * inverse_z
        by_points[0, 1] = by_points[1, 0] = xy = xy * inverse_z
        by_points[1, 1] = yy = yy * inverse_z
        by_points[0, 2] = -(xx * x + xy * y)
        by_points[1, 2] = -(xy * x + yy * y)
        return image, by_points, by_k

    def distort(self, ideal: Array, k: Array) -> Array:
        """Return image coordinates (..., 2) of ideal ones (..., 2)."""
        return np.stack(self._image(ideal[..., 0], ideal[..., 1], k), axis=-1)

    def _image(self, x: Array, y: Array, k: Array) -> tuple[Array, Array]:
        """Return image coordinates (...) of ideal ones (...), each by itself."""
        p1, p2 = k[..., 2], k[..., 3]
        xx, yy, xy = x * x, y * y, x * y
        r2, xy2 = xx + yy, xy + xy
        radial = self.radial(r2, k)
        return (
            x * radial + p1 * xy2 + p2 * (r2 + xx + xx),
            y * radial + p1 * (r2 + yy + yy) + p2 * xy2,
        )

    def _linearised(self, x: Array, y: Array, k: Array) -> tuple[Array, tuple[Array, Array, Array], Array]:
        """Return the image (..., 2) of ideal coordinates x, y (...), and its derivatives.

        Those by the ideal coordinates are a symmetric matrix: xx, xy and yy. Those by k are (2, c, ...). All
        is written component by component: that is how memory is walked through in one piece.
        """
        p1, p2 = k[..., 2], k[..., 3]
        xx, xy, yy = x * x, x * y, y * y
        r2 = xx + yy
        radial, slope, factors = self.radial_with_jacobians(r2, k)
        by_k = np.empty((2, k.shape[-1], *x.shape))
        for index, factor in zip((0, 1, 4, 5, 6, 7), factors, strict=False):
            by_k[0, index], by_k[1, index] = x * factor, y * factor
        by_k[0, 2] = by_k[1, 3] = xy2 = xy + xy
        by_k[1, 2] = along_y = r2 + yy + yy
        by_k[0, 3] = along_x = r2 + xx + xx
        image = np.empty((2, *x.shape))
        image[0] = x * radial + p1 * xy2 + p2 * along_x
        image[1] = y * radial + p1 * along_y + p2 * xy2
        p1, p2 = p1 + p1, p2 + p2
        both = radial + p2 * x + p1 * y
        xx = slope * xx + both + 2.0 * p2 * x
        yy = slope * yy + both + 2.0 * p1 * y
        xy = slope * xy + p1 * x + p2 * y
        return image.transpose(*range(1, image.ndim), 0), (xx, xy, yy), by_k

    def unproject(self, image: Array, k: Array) -> Array:
        """Return directions (..., 3) with z = 1 of image coordinates (..., 2); NaN beyond the reach.

        Newton's method on the lens's own Jacobian, which converges in the image corner where a fixed-point
        iteration of five steps (OpenCV's default) is up to a pixel off.
        """
        limit = self._enough(image, k)
        if limit is None:
            limit = math.inf if self.grows_up_to(k, FARTHEST) else self.reach_of(k)
            # No direction leads there: the iterations would go on to their last for nothing.
            image = np.where(self._is_beyond(image, k, limit)[..., None], np.nan, image)
        x, y, good = self._newton(image, k, limit)
        rays = np.empty((*image.shape[:-1], 3))
        rays[..., 0], rays[..., 1], rays[..., 2] = x, y, 1.0
        rays[~good] = np.nan
        return rays

    def _enough(self, image: Array, k: Array) -> float | None:
        """Return an ideal radius before the fold within which all image points (..., 2) lie, None without.

        That is mostly so, and takes less to tell than where the fold is.
        """
        farthest = math.sqrt(np.sum(image * image, axis=-1).max(initial=0.0))
        radius = FARTHEST * TABLE
        moved = TANGENTIAL * (abs(float(k[2])) + abs(float(k[3]))) * radius
        first = int(np.argmax(radius * (self.radial(radius * radius, k) - moved) > farthest))
        return float(radius[first]) if first and self.grows_up_to(k, float(radius[first])) else None

    def _is_beyond(self, image: Array, k: Array, limit: float) -> NDArray[np.bool_]:
        """Return which image points (...) are clearly beyond the image of the fold.

        On the fold, opposite points have opposite radial parts and the same tangential one, whose share moves
        the image of the fold by about its square.
        """
        radius = np.sqrt(np.sum(image * image, axis=-1))
        well_before = WELL_BEFORE * limit
        if limit > FARTHEST or radius.max(initial=0.0) < well_before * self.radial(
            np.array(well_before**2), k
        ):
            return np.zeros(radius.shape, dtype=np.bool_)
        # A little before it, as it may be a pole.
        fold = image * ((1.0 - 1e-6) * limit / np.maximum(radius, 1e-12))[..., None]
        here, opposite = self.distort(fold, k), self.distort(-fold, k)
        across = np.linalg.norm(here - opposite, axis=-1)
        share = np.linalg.norm(here + opposite, axis=-1) / np.maximum(across, 1e-12)
        return np.asarray(radius > np.linalg.norm(here, axis=-1) * (1.0 + 1e-9 + CLEARLY * share**2))

    def _newton(self, image: Array, k: Array, limit: float) -> tuple[Array, Array, NDArray[np.bool_]]:
        """Return ideal coordinates x, y (...) of image points (..., 2), and whether they give those (...).

        The slope of one step serves the next ones, as long as each is much shorter than the one before.
        """
        u, v = np.array(image[..., 0]), np.array(image[..., 1])
        x, y = self._start(u, v, k, limit)
        slope: tuple[Array, Array, Array] | None = None
        longest = math.inf
        for _ in range(ITERATIONS):
            if slope is None:
                there, slope, _ = self._linearised(x, y, k)
                left_u, left_v = u - there[..., 0], v - there[..., 1]
            else:
                seen_u, seen_v = self._image(x, y, k)
                left_u, left_v = u - seen_u, v - seen_v
            step_x, step_y = _solve_2x2(slope, left_u, left_v)
            steps = np.maximum(np.abs(step_x), np.abs(step_y))
            before, longest = longest, float(np.fmax.reduce(steps, axis=None, initial=0.0))
            if longest < SMALL_STEP:
                # What is left is that small too, but where the slope is singular and gives no step.
                steepest = np.abs(slope).max(axis=0)
                left = np.maximum(np.abs(left_u), np.abs(left_v))
                return x + step_x, y + step_y, left < 4.0 * SMALL_STEP * steepest
            x, y = _before_fold(x, y, step_x, step_y, limit)
            if longest > min(SHORT_STEP, MUCH_SHORTER * before):
                slope = None
        seen_u, seen_v = self._image(x, y, k)
        return x, y, np.hypot(u - seen_u, v - seen_v) < GOOD

    def _start(self, u: Array, v: Array, k: Array, limit: float) -> tuple[Array, Array]:
        """Return x, y (...) along the image's own directions whose distorted radius is about the image's.

        From farther away Newton may leap about, as with a strongly bent quotient.
        """
        wanted = np.sqrt(u * u + v * v)
        radius = min(limit, FARTHEST) * TABLE
        found = np.interp(wanted, radius * self.radial(radius * radius, k), radius)
        outwards = found / np.maximum(wanted, 1e-12)
        return u * outwards, v * outwards

    def radius(self, points: Array) -> Array:
        """Return the ideal radius √(X² + Y²)/Z of points (..., 3), inf where Z is not positive."""
        x, y, z = points[..., 0], points[..., 1], points[..., 2]
        across = np.sqrt(x * x + y * y)
        if z.min(initial=np.inf) > 0:
            return np.asarray(across / z)
        return np.where(z > 0, across / np.where(z > 0, z, 1.0), np.where(np.isnan(z), np.nan, np.inf))

    def reach(self, k: Array) -> float:
        """Return the ideal radius up to which the distorted radius grows, inf where it always does."""
        return self.reach_of(k)

    def reaches(self, k: Array, radius: float) -> bool:
        """Whether the distorted radius grows up to an ideal radius."""
        return self.grows_up_to(k, radius)

    def like_division(self, coefficient: float) -> Array:
        """Return coefficients (c,) of a lens roughly like the division model, zero where there is none."""
        return np.zeros(len(self.coefficients)) if self.of_division is None else self.of_division(coefficient)


def _before_fold(x: Array, y: Array, step_x: Array, step_y: Array, limit: float) -> tuple[Array, Array]:
    """Return x, y (...) after a step, or half-way to the fold where the step leads beyond it.

    At the fold itself the Jacobian is singular, and an iteration that is put there stays there.
    """
    moved_x, moved_y = x + step_x, y + step_y
    if limit == math.inf:
        return moved_x, moved_y
    length = np.sqrt(moved_x * moved_x + moved_y * moved_y)
    beyond = length >= limit
    if not np.any(beyond):
        return moved_x, moved_y
    halfway = 0.5 * (np.sqrt(x * x + y * y) + limit)
    back = np.where(beyond, halfway / np.maximum(length, 1e-12), 1.0)
    return moved_x * back, moved_y * back


def _solve_2x2(matrix: tuple[Array, Array, Array], u: Array, v: Array) -> tuple[Array, Array]:
    """Solve symmetric systems xx, xy, yy for u, v (...) by Cramer's rule; singular ones give zero."""
    a, b, d = matrix
    determinant = a * d - b * b
    inverse = 1.0 / np.where(np.abs(determinant) < 1e-12, np.inf, determinant)
    return (d * u - b * v) * inverse, (a * v - b * u) * inverse
