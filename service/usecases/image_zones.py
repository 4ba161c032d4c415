"""Values over the image as they are shown: grids of cells, and the zones that are drawn over them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.uncertainty import Region

Rows = list[list[float | None]]


@dataclass(frozen=True)
class Rectangle:
    """A part of the image, px."""

    left_px: float
    top_px: float
    right_px: float
    bottom_px: float


def rectangle_of(region: Region) -> Rectangle:
    """Return a region as it is shown."""
    return Rectangle(region.left_px, region.top_px, region.right_px, region.bottom_px)


def rows_of(values: NDArray[np.float64]) -> Rows:
    """Return values (rows, columns) as JSON can say them, to five digits: a drawing needs no more."""
    return [[None if not np.isfinite(v) else float(f"{v:.5g}") for v in row] for row in values]
