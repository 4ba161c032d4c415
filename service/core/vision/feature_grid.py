"""Features in rows and columns, as most targets have them: places, outermost ones, the squares around.

Not here: what a kind of target prints into them (`target_*.py`).
"""

import numpy as np
from numpy.typing import NDArray

from service.core.vision.printed import Area, square_area
from service.core.vision.transforms import Array


def grid_points(columns: int, rows: int, step_m: float) -> Array:
    """Return an even grid (rows * columns, 3), m: row by row, z = 0."""
    grid = np.zeros((rows * columns, 3))
    grid[:, 0] = np.tile(np.arange(columns), rows) * step_m
    grid[:, 1] = np.repeat(np.arange(rows), columns) * step_m
    return grid


def grid_outer(columns: int, rows: int) -> tuple[int, int, int, int]:
    """Return the indices of the outermost features: top left, top right, bottom right, bottom left."""
    last = rows * columns - 1
    return 0, columns - 1, last, last - columns + 1


def grid_outline(columns: int, rows: int, step_m: float) -> Array:
    """Return the corners (4, 3), m, of a rectangle one step beyond an even grid, in the same order."""
    return rectangle(-step_m, -step_m, columns * step_m, rows * step_m)


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
