"""The rational lens with eight coefficients (k1 k2 p1 p2 k3 k4 k5 k6): OpenCV's CALIB_RATIONAL_MODEL.

Works on ideal image-plane coordinates x = X/Z, y = Y/Z; the radial factor is a quotient (1 + k1 r² + k2 r⁴ +
k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶), which follows a wide lens farther out than a polynomial. Formulas:
OpenCV's calib3d page.
"""

import math

import numpy as np

from service.core.vision.perspective import PerspectiveLens
from service.core.vision.transforms import Array


def distort(xy: Array, k: Array) -> Array:
    """Return distorted coordinates (..., 2) of ideal ones (..., 2); k: (8,) or broadcastable (..., 8)."""
    x, y = xy[..., 0], xy[..., 1]
    k1, k2, p1, p2, k3, k4, k5, k6 = (k[..., i] for i in range(8))
    xx, yy, xy2 = x * x, y * y, 2.0 * x * y
    r2 = xx + yy
    radial = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    xd = x * radial + p1 * xy2 + p2 * (r2 + 2.0 * xx)
    yd = y * radial + p1 * (r2 + 2.0 * yy) + p2 * xy2
    return np.stack([xd, yd], axis=-1)


def distort_with_jacobians(xy: Array, k: Array) -> tuple[Array, Array, Array]:
    """Return the distorted point (..., 2), its derivatives by xy (2, 2, ...) and by k (2, 8, ...)."""
    x, y = xy[..., 0], xy[..., 1]
    k1, k2, p1, p2, k3, k4, k5, k6 = (k[..., i] for i in range(8))
    xx, yy, xy2 = x * x, y * y, 2.0 * x * y
    r2 = xx + yy
    inverse = 1.0 / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    radial = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) * inverse
    above = k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3)
    below = k4 + r2 * (2.0 * k5 + 3.0 * r2 * k6)
    slope = 2.0 * (above - radial * below) * inverse
    tangential_x, tangential_y = 2.0 * (p2 * x + p1 * y), 2.0 * (p1 * x + p2 * y)
    by_xy = np.empty((2, 2, *x.shape))
    by_xy[0, 0] = radial + slope * xx + tangential_x + 4.0 * p2 * x
    by_xy[0, 1] = by_xy[1, 0] = 0.5 * slope * xy2 + tangential_y
    by_xy[1, 1] = radial + slope * yy + tangential_x + 4.0 * p1 * y
    by_k = np.empty((2, 8, *x.shape))
    by_k[0, 0], by_k[1, 0] = x * r2 * inverse, y * r2 * inverse
    by_k[:, 1] = by_k[:, 0] * r2
    by_k[:, 4] = by_k[:, 1] * r2
    for above_index, below_index in ((0, 5), (1, 6), (4, 7)):
        by_k[:, below_index] = -radial * by_k[:, above_index]
    by_k[0, 2] = by_k[1, 3] = xy2
    by_k[0, 3] = r2 + 2.0 * xx
    by_k[1, 2] = r2 + 2.0 * yy
    distorted = np.empty((*x.shape, 2))
    distorted[..., 0] = x * radial + p1 * xy2 + p2 * by_k[0, 3]
    distorted[..., 1] = y * radial + p1 * by_k[1, 2] + p2 * xy2
    return distorted, by_xy, by_k


def monotone_radius(k: Array) -> float:
    """Return the ideal radius up to which the distorted radius grows (inf where it always does).

    With t = r² and the quotient N/D, r N/D turns where (N + 2t N′)D − 2t N D′ has its smallest positive root,
    and ends where D has one. Both polynomials are one at t = 0.
    """
    k1, k2, _, _, k3, k4, k5, k6 = (float(value) for value in k)
    N, D = np.array([1.0, k1, k2, k3]), np.array([1.0, k4, k5, k6])
    twice = 2.0 * np.arange(4)
    turning = np.convolve(N * (1.0 + twice), D) - np.convolve(N, D * twice)
    smallest = min(_smallest_positive_root(turning), _smallest_positive_root(D))
    return math.sqrt(smallest)


def _smallest_positive_root(ascending: Array) -> float:
    """Return the smallest positive real root of 1 + a t + b t² + …, inf without one.

    In 1/t it is the largest root of a polynomial whose leading coefficient is one, which stays well defined
    where the highest coefficients vanish.
    """
    companion = np.diag(np.ones(len(ascending) - 2), -1)
    companion[0] = -ascending[1:]
    roots = np.linalg.eigvals(companion)
    size = max(1.0, float(np.abs(ascending[1:]).max()))
    # Rounding gives a double root an imaginary part; below the second bound a root is rounding alone.
    real = roots.real[(np.abs(roots.imag) < 1e-7 * size) & (roots.real > 1e-6 * size)]
    return 1.0 / float(real.max()) if len(real) else math.inf


LENS = PerspectiveLens(
    "rational8",
    ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"),
    distort,
    distort_with_jacobians,
    monotone_radius,
    weak=("k6",),
    sweep_hfov_deg=(40.0, 60.0, 90.0, 120.0, 140.0),
)
