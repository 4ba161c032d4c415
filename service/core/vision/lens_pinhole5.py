"""The pinhole lens with five coefficients (k1 k2 p1 p2 k3), the paper's Δ(·) and OpenCV's default model.

Works on ideal image-plane coordinates x = X/Z, y = Y/Z. Formulas: Brown (1966) as in OpenCV's calib3d page.
"""

import numpy as np

from service.core.vision.transforms import Array

NAME = "pinhole5"
COEFFICIENTS = ("k1", "k2", "p1", "p2", "k3")


def distort(xy: Array, k: Array) -> Array:
    """Return distorted coordinates (..., 2) of ideal ones (..., 2); k: (5,) or broadcastable (..., 5)."""
    x, y = xy[..., 0], xy[..., 1]
    k1, k2, p1, p2, k3 = (k[..., i] for i in range(5))
    r2 = x * x + y * y
    radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)
    yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y
    return np.stack([xd, yd], axis=-1)


def distort_jacobians(xy: Array, k: Array) -> tuple[Array, Array]:
    """Return derivatives of the distorted point by xy (..., 2, 2) and by the coefficients (..., 2, 5)."""
    x, y = xy[..., 0], xy[..., 1]
    k1, k2, p1, p2, k3 = (k[..., i] for i in range(5))
    r2 = x * x + y * y
    radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    slope = 2.0 * (k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3))
    by_xy = np.empty((*x.shape, 2, 2))
    by_xy[..., 0, 0] = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x
    by_xy[..., 0, 1] = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y
    by_xy[..., 1, 0] = by_xy[..., 0, 1]
    by_xy[..., 1, 1] = radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x
    by_k = np.empty((*x.shape, 2, 5))
    for axis, value in enumerate((x, y)):
        by_k[..., axis, 0] = value * r2
        by_k[..., axis, 1] = value * r2 * r2
        by_k[..., axis, 4] = value * r2 * r2 * r2
    by_k[..., 0, 2] = 2.0 * x * y
    by_k[..., 0, 3] = r2 + 2.0 * x * x
    by_k[..., 1, 2] = r2 + 2.0 * y * y
    by_k[..., 1, 3] = 2.0 * x * y
    return by_xy, by_k


def monotone_radius(k: Array) -> float:
    """Return the ideal radius up to which the distorted radius grows (inf where it always does).

    The radial part r(1 + k1 r² + k2 r⁴ + k3 r⁶) turns at the smallest positive root of its derivative.
    """
    roots = np.roots([7.0 * k[4], 5.0 * k[1], 3.0 * k[0], 1.0])
    real = roots[np.abs(roots.imag) < 1e-9].real
    positive = real[real > 0]
    return float(np.sqrt(positive.min())) if positive.size else float("inf")
