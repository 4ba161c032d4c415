"""What a target's print is made of: dark areas and discs on white, m, in the board's frame.

From these shapes sheets are printed, screens filled and virtual pictures drawn.
Not here: which shapes a target has (`target_*.py`), how they are drawn.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.vision.transforms import Array


@dataclass(frozen=True)
class Area:
    """A dark area inside closed loops (k, 2), m, by the even-odd rule: a loop within a loop is a hole."""

    loops: tuple[Array, ...]


@dataclass(frozen=True)
class Disc:
    """A dark disc: centre (2,) and radius, m."""

    centre: Array
    radius_m: float


Shape = Area | Disc


def square_area(left_m: float, top_m: float, side_m: float) -> Area:
    """Return a dark square by its corner nearest to the origin and its side, m."""
    unit = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    return Area((np.array([left_m, top_m]) + side_m * unit,))


def cells_area(dark: NDArray[np.bool_], left_m: float, top_m: float, cell_m: float) -> Area:
    """Return the dark cells (rows, columns) of a grid as one area without seams between cells."""
    loops = trace_cells(dark)
    return Area(tuple(np.array([left_m, top_m]) + cell_m * loop for loop in loops))


def trace_cells(dark: NDArray[np.bool_]) -> list[Array]:
    """Return the borders of dark cells (rows, columns) as loops (k, 2) of (column, row) corners."""
    following = _borders(dark)
    loops = []
    while following:
        start = here = next(iter(following))
        loop = []
        while True:
            loop.append(here)
            ends = following[here]
            here = ends.pop()
            if not ends:
                del following[loop[-1]]
            if here == start:
                break
        loops.append(_without_straight(np.array(loop, dtype=np.float64)))
    return loops


def _borders(dark: NDArray[np.bool_]) -> dict[tuple[int, int], list[tuple[int, int]]]:
    """Return the sides between dark and bright, directed with the dark to the right: ends by start."""
    around = np.pad(dark, 1)
    following: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for row, column in np.argwhere(dark):
        x, y = int(column), int(row)
        sides = {
            (0, 1): ((x, y), (x + 1, y)),
            (1, 2): ((x + 1, y), (x + 1, y + 1)),
            (2, 1): ((x + 1, y + 1), (x, y + 1)),
            (1, 0): ((x, y + 1), (x, y)),
        }
        for (down, right), (start, end) in sides.items():
            if not around[y + down, x + right]:
                following.setdefault(start, []).append(end)
    return following


def _without_straight(loop: Array) -> Array:
    """Return a loop (k, 2) without the points at which it does not turn."""
    before, after = loop - np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0) - loop
    turns = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.ascontiguousarray(loop[turns != 0])
