"""The fisheye lens with four coefficients (k1 k2 k3 k4): Kannala and Brandt (2006) as in OpenCV's `fisheye`.

The image radius is θd = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸) of the angle θ from the axis, so that nothing
happens at 90 degrees; without coefficients the lens is equidistant. No tangential part, no skew.
"""

import math

import numpy as np

from service.core.vision.polynomial import is_positive_up_to, smallest_positive_root
from service.core.vision.transforms import Array

HALVINGS = 60
NEAR_AXIS = 1e-8  # rad; the series about the axis is exact to rounding there


class KannalaBrandt4:
    """See the module."""

    name = "kannala_brandt4"
    coefficients = ("k1", "k2", "k3", "k4")
    weak = ()
    sweep_hfov_deg = (60.0, 90.0, 120.0, 160.0, 200.0)

    def project(self, points: Array, k: Array) -> Array:
        """Return image coordinates (..., 2) of points (..., 3)."""
        theta = self.radius(points)
        across = np.hypot(points[..., 0], points[..., 1])
        scale = _scale(theta * _factor(theta * theta, k), across, points[..., 2])
        return points[..., :2] * scale[..., None]

    def project_with_jacobians(self, points: Array, k: Array) -> tuple[Array, Array, Array]:
        """Return image coordinates (..., 2), derivatives by points (2, 3, ...) and by k (2, 4, ...).

        With s = θd/ρ and ρ² = X² + Y²: ∂s/∂ρ = (θd′ Z/(ρ² + Z²) − s)/ρ, ∂s/∂Z = −θd′/(ρ² + Z²).
        """
        x, y, z = points[..., 0], points[..., 1], points[..., 2]
        across_sq = x * x + y * y
        across = np.sqrt(across_sq)
        theta = np.arctan2(across, z)
        t = theta * theta
        slope = _slope(t, k) / (across_sq + z * z)
        s = _scale(theta * _factor(t, k), across, z)
        curl = (slope * z - s) / np.where(across > 0.0, across_sq, np.inf)
        by_points = np.empty((2, 3, *x.shape))
        by_points[0, 0] = s + curl * x * x
        by_points[0, 1] = by_points[1, 0] = curl * x * y
        by_points[1, 1] = s + curl * y * y
        by_points[0, 2], by_points[1, 2] = -slope * x, -slope * y
        by_k = np.empty((2, 4, *x.shape))
        power = _scale(theta, across, z) * t
        for i in range(4):
            by_k[0, i], by_k[1, i] = power * x, power * y
            power = power * t
        return np.stack([s * x, s * y], axis=-1), by_points, by_k

    def unproject(self, image: Array, k: Array) -> Array:
        """Return unit directions (..., 3) of image coordinates (..., 2), k (4,); NaN beyond the reach."""
        image = np.asarray(image, dtype=np.float64)
        wanted = np.hypot(image[..., 0], image[..., 1])
        theta = _angle(wanted, k, self.reach(k))
        sine = np.sin(theta) / np.where(wanted > 0.0, wanted, 1.0)
        return np.concatenate([image * sine[..., None], np.cos(theta)[..., None]], axis=-1)

    def radius(self, points: Array) -> Array:
        """Return the angle (...) from the axis of points (..., 3), 0…π rad."""
        angle: Array = np.arctan2(np.hypot(points[..., 0], points[..., 1]), points[..., 2])
        return angle

    def reach(self, k: Array) -> float:
        """Return the angle, rad, up to which the image radius grows; π where it always does.

        θd′ = 1 + 3 k1 t + 5 k2 t² + 7 k3 t³ + 9 k4 t⁴ with t = θ².
        """
        return math.sqrt(min(smallest_positive_root(_turning(k)), math.pi**2))

    def reaches(self, k: Array, radius: float) -> bool:
        """Whether the image radius grows up to an angle, rad."""
        return radius < math.pi and is_positive_up_to(_turning(k), radius * radius)

    def like_division(self, coefficient: float) -> Array:
        """Return no coefficients (4,): the equidistant lens is near enough to the division model of any."""
        return np.zeros(4)


def _turning(k: Array) -> list[float]:
    """Return dθd/dθ of k (4,) as a polynomial in θ²."""
    return [1.0, *(power * one for power, one in zip((3.0, 5.0, 7.0, 9.0), k.tolist(), strict=True))]


def _factor(t: Array, k: Array) -> Array:
    """Return θd/θ (...) of t = θ² (...); k: (4,) or broadcastable (..., 4)."""
    k1, k2, k3, k4 = (k[..., i] for i in range(4))
    factor: Array = 1.0 + t * (k1 + t * (k2 + t * (k3 + t * k4)))
    return factor


def _slope(t: Array, k: Array) -> Array:
    """Return dθd/dθ (...) of t = θ² (...)."""
    k1, k2, k3, k4 = (k[..., i] for i in range(4))
    slope: Array = 1.0 + t * (3.0 * k1 + t * (5.0 * k2 + t * (7.0 * k3 + t * 9.0 * k4)))
    return slope


def _scale(angle: Array, across: Array, z: Array) -> Array:
    """Return angle/ρ (...), by its limit 1/Z next to the axis; NaN straight behind."""
    ahead = np.where(z > 0.0, z, np.nan)
    near = across <= NEAR_AXIS * np.abs(z)
    return np.where(near, 1.0 / ahead, angle / np.where(near, 1.0, across))


def _angle(wanted: Array, k: Array, reach: float) -> Array:
    """Return the angles θ (...) whose θd is wanted (...), NaN beyond the reach.

    Newton's method between bounds that close in: θd grows up to the reach, so that there is one answer.
    """
    low, high = np.zeros_like(wanted), np.full_like(wanted, reach)
    theta = np.minimum(wanted, 0.9 * reach)
    for _ in range(HALVINGS):
        t = theta * theta
        miss = theta * _factor(t, k) - wanted
        low, high = np.where(miss < 0, theta, low), np.where(miss > 0, theta, high)
        following = theta - miss / np.maximum(_slope(t, k), 1e-9)
        inside = (following >= low) & (following <= high)
        following = np.where(inside, following, 0.5 * (low + high))
        moves = np.abs(following - theta) > 1e-15 * reach
        theta = following
        if not np.any(moves):
            break
    miss = np.abs(theta * _factor(theta * theta, k) - wanted)
    return np.where(miss < 1e-11, theta, np.nan)


LENS = KannalaBrandt4()
