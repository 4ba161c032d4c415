"""The pinhole lens with five coefficients (k1 k2 p1 p2 k3), the paper's Δ(·) and OpenCV's default model.

Works on ideal image-plane coordinates x = X/Z, y = Y/Z. Formulas: Brown (1966) as in OpenCV's calib3d page.
"""

import math

import numpy as np

from service.core.vision.perspective import PerspectiveLens
from service.core.vision.transforms import Array


def radial(r2: Array, k: Array) -> Array:
    """Return the radial factor (...) of r² (...); k: (5,) or broadcastable (..., 5)."""
    k1, k2, k3 = k[..., 0], k[..., 1], k[..., 4]
    return np.asarray(1.0 + r2 * (k1 + r2 * (k2 + r2 * k3)))


def radial_with_jacobians(r2: Array, k: Array) -> tuple[Array, Array, tuple[Array, ...]]:
    """Return the radial factor (...), twice its derivative by r², and those by k1, k2, k3."""
    k1, k2, k3 = k[..., 0], k[..., 1], k[..., 4]
    slope = 2.0 * k1 + r2 * (4.0 * k2 + r2 * (6.0 * k3))
    r4 = r2 * r2
    return radial(r2, k), slope, (r2, r4, r4 * r2)


def monotone_radius(k: Array) -> float:
    """Return the ideal radius up to which the distorted radius grows (inf where it always does).

    The radial part r(1 + k1 r² + k2 r⁴ + k3 r⁶) turns where 1 + 3 k1 r² + 5 k2 r⁴ + 7 k3 r⁶ has its smallest
    positive root; in 1/r² that is the largest root of a cubic whose leading coefficient is one.
    """
    a, b, c = 3.0 * float(k[0]), 5.0 * float(k[1]), 7.0 * float(k[4])
    largest = _largest_cubic_root(a, b, c)
    # Below this the root is rounding, and the fold, if there is one, some 0.1 degrees from the image plane.
    return 1.0 / math.sqrt(largest) if largest > 1e-6 * max(1.0, abs(a)) else math.inf


def grows_to(k: Array, radius: float) -> bool:
    """Whether the distorted radius grows up to an ideal radius."""
    return radius < monotone_radius(k)


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
    "pinhole5", ("k1", "k2", "p1", "p2", "k3"), radial, radial_with_jacobians, monotone_radius, grows_to
)
