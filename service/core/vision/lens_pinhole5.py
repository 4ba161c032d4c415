"""The pinhole lens with five coefficients (k1 k2 p1 p2 k3), the paper's Δ(·) and OpenCV's default model.

Works on ideal image-plane coordinates x = X/Z, y = Y/Z. Formulas: Brown (1966) as in OpenCV's calib3d page.
"""

import math

import numpy as np

from service.core.vision.perspective import PerspectiveLens
from service.core.vision.transforms import Array


def distort(xy: Array, k: Array) -> Array:
    """Return distorted coordinates (..., 2) of ideal ones (..., 2); k: (5,) or broadcastable (..., 5)."""
    x, y = xy[..., 0], xy[..., 1]
    k1, k2, p1, p2, k3 = (k[..., i] for i in range(5))
    xx, yy, xy2 = x * x, y * y, 2.0 * x * y
    r2 = xx + yy
    radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    xd = x * radial + p1 * xy2 + p2 * (r2 + 2.0 * xx)
    yd = y * radial + p1 * (r2 + 2.0 * yy) + p2 * xy2
    return np.stack([xd, yd], axis=-1)


def distort_with_jacobians(xy: Array, k: Array) -> tuple[Array, Array, Array]:
    """Return the distorted point (..., 2), its derivatives by xy (2, 2, ...) and by k (2, 5, ...).

    The components come first in memory, so that each is written in one stroke.
    """
    x, y = xy[..., 0], xy[..., 1]
    k1, k2, p1, p2, k3 = (k[..., i] for i in range(5))
    xx, yy, xy2 = x * x, y * y, 2.0 * x * y
    r2 = xx + yy
    radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    slope = 2.0 * (k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3))
    tangential_x, tangential_y = 2.0 * (p2 * x + p1 * y), 2.0 * (p1 * x + p2 * y)
    by_xy = np.empty((2, 2, *x.shape))
    by_xy[0, 0] = radial + slope * xx + tangential_x + 4.0 * p2 * x
    by_xy[0, 1] = by_xy[1, 0] = 0.5 * slope * xy2 + tangential_y
    by_xy[1, 1] = radial + slope * yy + tangential_x + 4.0 * p1 * y
    by_k = np.empty((2, 5, *x.shape))
    by_k[0, 0], by_k[1, 0] = x * r2, y * r2
    by_k[:, 1] = by_k[:, 0] * r2
    by_k[:, 4] = by_k[:, 1] * r2
    by_k[0, 2] = by_k[1, 3] = xy2
    by_k[0, 3] = r2 + 2.0 * xx
    by_k[1, 2] = r2 + 2.0 * yy
    distorted = np.empty((*x.shape, 2))
    distorted[..., 0] = x * radial + p1 * xy2 + p2 * by_k[0, 3]
    distorted[..., 1] = y * radial + p1 * by_k[1, 2] + p2 * xy2
    return distorted, by_xy, by_k


def monotone_radius(k: Array) -> float:
    """Return the ideal radius up to which the distorted radius grows (inf where it always does).

    The radial part r(1 + k1 r² + k2 r⁴ + k3 r⁶) turns where 1 + 3 k1 r² + 5 k2 r⁴ + 7 k3 r⁶ has its smallest
    positive root; in 1/r² that is the largest root of a cubic whose leading coefficient is one.
    """
    a, b, c = 3.0 * float(k[0]), 5.0 * float(k[1]), 7.0 * float(k[4])
    largest = _largest_cubic_root(a, b, c)
    # Below this the root is rounding, and the fold, if there is one, some 0.1 degrees from the image plane.
    return 1.0 / math.sqrt(largest) if largest > 1e-6 * max(1.0, abs(a)) else math.inf


def _largest_cubic_root(a: float, b: float, c: float) -> float:
    """Return the largest real root of t³ + a t² + b t + c (Cardano; Viète where there are three)."""
    p = b - a * a / 3.0
    q = 2.0 * a**3 / 27.0 - a * b / 3.0 + c
    discriminant = q * q / 4.0 + p**3 / 27.0
    if discriminant > 0.0:
        # Of the two cube roots the larger is taken from the formula and the other from their product.
        u = math.cbrt(-q / 2.0 - math.copysign(math.sqrt(discriminant), q))
        y = u - p / (3.0 * u)
    else:
        radius = math.sqrt(max(-p, 0.0) / 3.0)
        cosine = -q / (2.0 * radius**3) if radius > 1e-100 else 0.0
        y = 2.0 * radius * math.cos(math.acos(min(1.0, max(-1.0, cosine))) / 3.0)
    return y - a / 3.0


LENS = PerspectiveLens(
    "pinhole5", ("k1", "k2", "p1", "p2", "k3"), distort, distort_with_jacobians, monotone_radius
)
