"""Features in rows and columns, as most targets have them: places, outermost ones, the squares around.

Not here: what a kind of target prints into them (`target_*.py`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.printed import Area, square_area
from service.core.vision.transforms import Array


@dataclass(frozen=True)
class SquareGrid:
    """The corners between the squares of a board: inner corners (columns x rows), the side of a square, m."""

    columns: int
    rows: int
    square_m: float

    @property
    def reach_m(self) -> float:
        """Nothing: an inner corner is seen as soon as it is in the picture."""
        return 0.0

    @property
    def object_points(self) -> Array:
        """Inner corners (rows * columns, 3), m: row by row, z = 0."""
        row, column = np.divmod(np.arange(self.rows * self.columns), self.columns)
        return np.stack([column, row, np.zeros(len(row))], axis=-1) * self.square_m

    @property
    def centre(self) -> Array:
        """The middle of the corners (3,), m."""
        return np.array([(self.columns - 1) / 2, (self.rows - 1) / 2, 0.0]) * self.square_m

    @property
    def outer_corners(self) -> tuple[int, int, int, int]:
        """Indices of the four outermost corners: top left, top right, bottom right, bottom left."""
        return grid_outer(self.columns, self.rows)

    @property
    def outline(self) -> Array:
        """Corners (4, 3), m, of the printed pattern: one square beyond the outermost corners."""
        side = self.square_m
        return rectangle(-side, -side, self.columns * side, self.rows * side)


def grid_outer(columns: int, rows: int) -> tuple[int, int, int, int]:
    """Return the indices of the outermost features: top left, top right, bottom right, bottom left."""
    last = rows * columns - 1
    return 0, columns - 1, last, last - columns + 1


def rectangle(left_m: float, top_m: float, right_m: float, bottom_m: float) -> Array:
    """Return the corners (4, 3), m: top left, top right, bottom right, bottom left."""
    return np.array(
        [
            (left_m, top_m, 0.0),
            (right_m, top_m, 0.0),
            (right_m, bottom_m, 0.0),
            (left_m, bottom_m, 0.0),
        ]
    )


def dark_squares(columns: int, rows: int, square_m: float) -> tuple[Area, ...]:
    """Return the dark squares of a chessboard with so many inner corners; the first square is dark."""
    return tuple(
        square_area(column * square_m, row * square_m, square_m)
        for row in range(-1, rows)
        for column in range(-1, columns)
        if (row + column) % 2 == 0
    )


def neighbours(columns: int, rows: int) -> NDArray[np.int64]:
    """Return the pairs (k, 2) of features beside and below each other."""
    number = np.arange(columns * rows).reshape(rows, columns)
    beside = np.stack([number[:, :-1], number[:, 1:]], axis=-1)
    below = np.stack([number[:-1], number[1:]], axis=-1)
    return np.concatenate([beside.reshape(-1, 2), below.reshape(-1, 2)])


def extent(object_points: Array) -> tuple[Array, Array]:
    """Return the smallest and the largest coordinates (2,), m, of features (n, 3)."""
    points = object_points[:, :2]
    return points.min(axis=0), points.max(axis=0)
