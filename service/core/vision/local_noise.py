"""The noise of corners without any camera model: what is left of residuals after a homography of each 3x3
patch.

A patch of nine corners is so small that lens, board and pose look like a homography across it, whatever they
are; what a homography cannot explain is noise. Compared with the residuals of the whole solve it tells how
much of these the camera model leaves behind (Hagemann et al., IJCV 2021, with patches instead of markers).
Not here: limits (`service.core.quality`).
"""

from collections.abc import Sequence

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from service.core.vision.target import Target
from service.core.vision.transforms import Array

PATCH = 3
UNKNOWNS = 8  # of a homography


def residual_grid(values: Array, corner_ids: NDArray[np.int64], target: Target) -> Array:
    """Return (n, 2) values of some corners by row and column: (rows, columns, 2), NaN where there is none."""
    grid = np.full((target.rows * target.columns, 2), np.nan)
    grid[corner_ids] = values
    return grid.reshape(target.rows, target.columns, 2)


def local_sigma(residuals: Sequence[Array], pixels: Sequence[Array]) -> float:
    """Return the standard deviation, px per coordinate, of corners about a homography of each patch.

    residuals, pixels: by view (rows, columns, 2) px, NaN where there is no corner. NaN where no view has a
    whole patch.
    """
    squares, count = 0.0, 0
    for residual, pixel in zip(residuals, pixels, strict=True):
        patches, places = _patches(residual), _patches(pixel)
        known = np.all(np.isfinite(patches), axis=(1, 2))
        if not known.any():
            continue
        squares += float(_unexplained(patches[known], places[known]).sum())
        count += int(known.sum())
    free = 2 * PATCH * PATCH - UNKNOWNS
    return float(np.sqrt(squares / (free * count))) if count else float("nan")


def neighbour_correlation(residuals: Sequence[Array]) -> float:
    """Return the correlation of the residuals of neighbouring corners; residuals as in `local_sigma`.

    Noise has none (a fit makes it slightly negative); a bent board or a wrong lens model has much.
    """
    product = weight = 0.0
    for grid in residuals:
        for a, b in ((grid[1:], grid[:-1]), (grid[:, 1:], grid[:, :-1])):
            both = np.isfinite(a[..., 0]) & np.isfinite(b[..., 0])
            product += float(np.sum(a[both] * b[both]))
            weight += 0.5 * float(np.sum(a[both] ** 2 + b[both] ** 2))
    return product / weight if weight > 0 else float("nan")


def _patches(grid: Array) -> Array:
    """Return all patches of a grid (rows, columns, 2) as (m, 9, 2)."""
    windows = sliding_window_view(grid, (PATCH, PATCH), axis=(0, 1))
    return np.moveaxis(windows, 2, -1).reshape(-1, PATCH * PATCH, 2)


def _unexplained(patches: Array, places: Array) -> Array:
    """Return the squares (m,) of residuals (m, 9, 2) that no small homography of places (m, 9, 2)
    explains."""
    offsets = places - places.mean(axis=1, keepdims=True)
    scale = np.linalg.norm(offsets, axis=2).max(axis=1)[:, None]
    x, y = offsets[..., 0] / scale, offsets[..., 1] / scale
    one, none = np.ones_like(x), np.zeros_like(x)
    along_x = np.stack([one, x, y, none, none, none, x * x, x * y], axis=-1)
    along_y = np.stack([none, none, none, one, x, y, x * y, y * y], axis=-1)
    basis, _ = np.linalg.qr(np.concatenate([along_x, along_y], axis=1))
    values = np.concatenate([patches[..., 0], patches[..., 1]], axis=1)
    explained = np.einsum("mkj,mk->mj", basis, values)
    squares: Array = np.sum(values**2, axis=1) - np.sum(explained**2, axis=1)
    return squares
