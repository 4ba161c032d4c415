"""The image cut into cells. Not here: what is in them (`error_maps`, and in planning `image_maps`)."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region

COLUMNS: Final = 40
Counts = NDArray[np.int64]


@dataclass(frozen=True)
class ImageGrid:
    """The image (width, height) px cut into cells as square as `columns` allows; row by row."""

    image_size: tuple[int, int]
    columns: int = COLUMNS

    @property
    def rows(self) -> int:
        """How many rows of cells there are."""
        width, height = self.image_size
        return max(1, round(self.columns * height / width))

    @property
    def centres(self) -> Array:
        """The cells' centres (rows * columns, 2), px; the image begins half a pixel before pixel 0."""
        width, height = self.image_size
        u, v = width / self.columns, height / self.rows
        return Region(u / 2 - 0.5, v / 2 - 0.5, width - 0.5 - u / 2, height - 0.5 - v / 2).grid(
            self.columns, self.rows
        )

    def count(self, image_points: Array) -> Counts:
        """Return how many points (..., 2) px fall into each cell: (rows, columns)."""
        return self.total(image_points, np.ones(image_points.shape[:-1])).astype(np.int64)

    def total(self, image_points: Array, values: Array) -> Array:
        """Return the sum of the values (...) of points (..., 2) px in each cell: (rows, columns)."""
        width, height = self.image_size
        u, v = image_points.reshape(-1, 2).T
        bounds = ((-0.5, height - 0.5), (-0.5, width - 0.5))
        sums, _, _ = np.histogram2d(
            v, u, bins=(self.rows, self.columns), range=bounds, weights=values.ravel()
        )
        return np.asarray(sums)
