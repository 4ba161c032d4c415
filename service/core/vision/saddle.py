"""Saddle points of the grey surface: where a chessboard corner is, to a few hundredths of a pixel.

A blurred corner is a hyperbolic paraboloid near its centre. The second-order surface fitted by least squares
over a disc is stationary at the corner; the disc is moved there and fitted again. On real pictures this is
nearer to the truth than `cv2.cornerSubPix`, and it does not depend on a window that may reach into the next
square.
Not here: which saddle points belong to a board.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.transforms import Array


def refine_saddles(
    blurred: FloatImage,
    points: Array,
    radii: NDArray[np.int64],
    iterations: int = 10,
    tolerance_px: float = 2e-3,
) -> tuple[Array, NDArray[np.bool_]]:
    """Return saddle points (n, 2) px near the given ones (n, 2), and which of them (n,) are proven.

    blurred: (h, w), smoothed; radii: (n,) of the discs, px, at least 2 and at most about 0.4 of the smallest
    square. A saddle point is proven when the surface curves both ways, the steps have died out and the disc
    has not left its own surroundings or the image; the others come back as they were given.
    """
    refined = np.array(points, dtype=np.float64)
    proven = np.zeros(len(refined), dtype=bool)
    for radius in np.unique(radii):
        group = np.flatnonzero(radii == radius)
        refined[group], proven[group] = _refine_group(
            blurred, refined[group], int(radius), iterations, tolerance_px
        )
    return refined, proven


def _refine_group(
    blurred: FloatImage, start: Array, radius: int, iterations: int, tolerance_px: float
) -> tuple[Array, NDArray[np.bool_]]:
    height, width = blurred.shape
    low, high = float(radius), np.array([width - 1.0 - radius, height - 1.0 - radius])
    points, step = start.copy(), np.full(start.shape, np.inf)
    inside = np.all((start >= low) & (start <= high), axis=1)
    active = np.flatnonzero(inside)
    for _ in range(iterations):
        if not active.size:
            break
        step[active] = _saddle_step(blurred, points[active], radius)
        points[active] += np.clip(step[active], -0.5 * radius, 0.5 * radius)
        moved = np.abs(points[active] - start[active]).max(axis=1)
        inside[active] = (moved <= 1.5 * radius) & np.all(
            (points[active] >= low) & (points[active] <= high), axis=1
        )
        active = active[inside[active] & (np.abs(step[active]).max(axis=1) > tolerance_px)]
    proven = inside & (np.abs(step).max(axis=1) < 0.05)
    return np.where(proven[:, None], points, start), proven


def _saddle_step(blurred: FloatImage, points: Array, radius: int) -> Array:
    """Steps (n, 2) px to the stationary points of the fitted surfaces; inf where the surface is no saddle."""
    offsets, fit = disc_fit(radius)
    values = sample_bilinear(blurred, points[:, :1] + offsets[:, 0], points[:, 1:] + offsets[:, 1])
    return saddle_of(values @ fit.T)


def saddle_of(surface: Array) -> Array:
    """Steps (n, 2) from the middle to the saddle of surfaces (n, 5) xx, xy, yy, x, y; inf if it is none."""
    xx, xy, yy, x, y = surface.T
    determinant = 4.0 * xx * yy - xy * xy
    saddle = determinant < -1e-12
    safe = np.where(saddle, determinant, -1.0)
    step = np.full((len(surface), 2), np.inf)
    step[saddle, 0] = ((xy * y - 2.0 * yy * x) / safe)[saddle]
    step[saddle, 1] = ((xy * x - 2.0 * xx * y) / safe)[saddle]
    return step


@lru_cache(maxsize=32)
def disc_fit(radius: int) -> tuple[Array, Array]:
    """Offsets (k, 2) of a disc and the matrix (5, k) that gives xx, xy, yy, x, y of its fitted surface."""
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1].astype(np.float64)
    disc = x * x + y * y <= (radius + 0.5) ** 2
    x, y = x[disc], y[disc]
    design = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)], axis=-1)
    return np.stack([x, y], axis=-1), np.linalg.pinv(design)[:5]
