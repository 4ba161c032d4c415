"""The rational lens with eight coefficients (k1 k2 p1 p2 k3 k4 k5 k6): OpenCV's CALIB_RATIONAL_MODEL.

Works on ideal image-plane coordinates x = X/Z, y = Y/Z; the radial factor is a quotient (1 + k1 r² + k2 r⁴ +
k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶), which follows a wide lens farther out than a polynomial. Formulas:
OpenCV's calib3d page.
"""

import math

import numpy as np

from service.core.vision.perspective import PerspectiveLens
from service.core.vision.polynomial import is_positive_up_to, smallest_positive_root
from service.core.vision.transforms import Array


def radial(r2: Array, k: Array) -> Array:
    """Return the radial factor (...) of r² (...); k: (8,) or broadcastable (..., 8)."""
    k1, k2, _, _, k3, k4, k5, k6 = (k[..., i] for i in range(8))
    above, below = r2 * (k1 + r2 * (k2 + r2 * k3)), r2 * (k4 + r2 * (k5 + r2 * k6))
    return np.asarray((1.0 + above) / (1.0 + below))


def radial_with_jacobians(r2: Array, k: Array) -> tuple[Array, Array, tuple[Array, ...]]:
    """Return the radial factor (...), twice its derivative by r², and those by k1, k2, k3, k4, k5, k6."""
    k1, k2, _, _, k3, k4, k5, k6 = (k[..., i] for i in range(8))
    inverse = 1.0 / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    factor = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) * inverse
    above = k1 + r2 * (2.0 * k2 + r2 * (3.0 * k3))
    below = k4 + r2 * (2.0 * k5 + r2 * (3.0 * k6))
    twice = 2.0 * inverse
    by_k1 = r2 * inverse
    by_k2 = by_k1 * r2
    by_k3 = by_k2 * r2
    minus = -factor
    by_k = (by_k1, by_k2, by_k3, minus * by_k1, minus * by_k2, minus * by_k3)
    return factor, (above + minus * below) * twice, by_k


def monotone_radius(k: Array) -> float:
    """Return the ideal radius up to which the distorted radius grows (inf where it always does)."""
    return math.sqrt(min(map(smallest_positive_root, _turning_and_below(k))))


def grows_to(k: Array, radius: float) -> bool:
    """Whether the distorted radius grows up to an ideal radius."""
    return all(is_positive_up_to(each, radius * radius) for each in _turning_and_below(k))


def of_division(coefficient: float) -> Array:
    """Return coefficients (8,) that bend like the division model where that bends as wide lenses do.

    With s = −c r² its inverse is m/r = 2/(1 + √(1 + 4 s)), of which (1 + s)/(1 + 2 s) is a Padé approximant.
    The next one is nearer, but from its k2 and k5, which do much the same, a solve takes twice as many steps.
    """
    bend = -min(coefficient, 0.0)
    return np.array([bend, 0.0, 0.0, 0.0, 0.0, 2.0 * bend, 0.0, 0.0])


def _turning_and_below(k: Array) -> tuple[list[float], list[float]]:
    """Return polynomials in t = r², one at zero, whose first positive root ends the growth.

    With the quotient N/D, r N/D turns where (N + 2t N′)D − 2t N D′ has one, and ends where D has one. To the
    coefficient of t^(i + j) a product N_i D_j of coefficients adds 1 + 2 i − 2 j times itself.
    """
    k1, k2, _, _, k3, k4, k5, k6 = k.tolist()
    turning = [0.0] * 7
    below = [1.0, k4, k5, k6]
    for i, n in enumerate((1.0, k1, k2, k3)):
        for j, d in enumerate(below):
            turning[i + j] += (1 + 2 * i - 2 * j) * n * d
    return turning, below


LENS = PerspectiveLens(
    "rational8",
    ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"),
    radial,
    radial_with_jacobians,
    monotone_radius,
    grows_to,
    of_division,
    weak=("k3", "k6"),
    sweep_hfov_deg=(40.0, 60.0, 90.0, 120.0, 140.0),
)
