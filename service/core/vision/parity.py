"""Do the squares alternate between dark and bright as a chessboard's must?

Not here: where the corners are.
"""

from dataclasses import dataclass

import numpy as np

from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.transforms import Array


@dataclass(frozen=True)
class Parity:
    """How well dark and bright squares separate.

    separation: (min bright − max dark) / (mean bright − mean dark) of the cell centres after the fall of
    light across the board has been taken out; at most 1, and below 0 when the squares do not alternate.
    contrast: mean bright − mean dark, grey levels; negative when dark and bright have changed places.
    """

    separation: float
    contrast: float


def measure_parity(blurred: FloatImage, corners: Array) -> Parity:
    """Return the parity of a board's corners (rows, columns, 2) px whose first cell should be dark."""
    values = _cell_values(blurred, corners)
    rows, columns = values.shape
    row, column = np.mgrid[:rows, :columns]
    sign = np.where((row + column) % 2 == 0, -1.0, 1.0).ravel()
    flat = values.ravel()
    contrast = float(flat[sign > 0].mean() - flat[sign < 0].mean())
    # Light that falls off is a plane of brightness and a plane of contrast.
    x, y = column.ravel() / max(columns - 1, 1) - 0.5, row.ravel() / max(rows - 1, 1) - 0.5
    plane = np.stack([np.ones_like(x), x, y], axis=-1)
    fit, *_ = np.linalg.lstsq(np.hstack([plane, plane * sign[:, None]]), flat, rcond=None)
    half = plane @ fit[3:]
    if np.any(half <= 0.0):
        return Parity(-1.0, contrast)
    level = (flat - plane @ fit[:3]) / half
    bright, dark = level[sign > 0], level[sign < 0]
    return Parity(float((bright.min() - dark.max()) / (bright.mean() - dark.mean())), contrast)


def _cell_values(blurred: FloatImage, corners: Array) -> Array:
    """Return the mean grey values (rows - 1, columns - 1) of the middles of the cells."""
    a, b, c, d = corners[:-1, :-1], corners[:-1, 1:], corners[1:, 1:], corners[1:, :-1]
    total = np.zeros(a.shape[:2])
    for u in (0.35, 0.5, 0.65):
        for v in (0.35, 0.5, 0.65):
            spot = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c)
            total += sample_bilinear(blurred, spot[..., 0], spot[..., 1])
    return total / 9.0
