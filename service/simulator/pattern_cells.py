"""Dark cells between upright lines, as markers and their boards have them. Not here: which cells are dark."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from service.core.errors import SceneInvalid
from service.core.vision.printed import Area
from service.core.vision.transforms import Array
from service.simulator.coverage import corner_share
from service.simulator.soft_edges import Levels, soft_step

SAME_LINE = 1e-6  # of a square: lines nearer to each other are one


@dataclass(frozen=True)
class Cells:
    """Lines of u (k,) and v (m,), squares, ascending; dark (m + 1, k + 1): cells before, between, after."""

    lines: tuple[Array, Array]
    dark: Array

    @property
    def finest(self) -> float:
        """The smallest distance of two lines."""
        return float(min(np.diff(lines).min() for lines in self.lines))

    def sample(self, uv: Array) -> NDArray[np.bool_]:
        """Return whether points (n, 2) lie in a dark cell."""
        column, row = (np.searchsorted(self.lines[axis], uv[:, axis]) for axis in range(2))
        return np.asarray(self.dark[row, column] > 0.5)

    def shares(self, uv: Array, jacobian: Array) -> Array:
        """Return the dark shares (n,) of pixels; exact where no pixel meets two lines of a direction."""
        column, row = (_nearest(self.lines[axis], uv[:, axis]) for axis in range(2))
        beyond = uv - np.stack([self.lines[0][column], self.lines[1][row]], axis=1)
        return _blend(self._around(column, row), *corner_share(beyond, jacobian))

    def near_edge(self, uv: Array, half: Array) -> NDArray[np.bool_]:
        """Return whether a line lies within half (n, 2) of points (n, 2)."""
        near = np.zeros(len(uv), dtype=bool)
        for axis, lines in enumerate(self.lines):
            nearest = lines[_nearest(lines, uv[:, axis])]
            near |= np.abs(uv[:, axis] - nearest) < half[:, axis]
        return near

    def soft_shares(self, u: Levels, v: Levels, footprint: tuple[Levels, Levels]) -> Levels:
        """Return the dark shares (h, w) of pixels, softly."""
        column, row = _nearest(self.lines[0], u), _nearest(self.lines[1], v)
        right = soft_step(u - self.lines[0].astype(np.float32)[column], footprint[0])
        below = soft_step(v - self.lines[1].astype(np.float32)[row], footprint[1])
        return np.asarray(_blend(self._around(column, row), right, below, right * below), dtype=np.float32)

    def _around(self, column: NDArray[np.intp], row: NDArray[np.intp]) -> tuple[Array, Array, Array, Array]:
        """Return the cells about crossings of lines: before both, beyond u's, beyond v's, beyond both."""
        dark = self.dark
        return dark[row, column], dark[row, column + 1], dark[row + 1, column], dark[row + 1, column + 1]


def make_cells(areas: Sequence[Area], square_m: float) -> Cells:
    """Return the cells of areas whose sides are upright; raises SceneInvalid for others."""
    loops = [loop / square_m for area in areas for loop in area.loops]
    points = np.concatenate(loops)
    lines = (_lines(points[:, 0]), _lines(points[:, 1]))
    toggles = np.zeros((len(lines[1]) + 1, len(lines[0]) + 1), dtype=np.int64)
    for loop in loops:
        _toggle(toggles, lines, loop)
    return Cells(lines, np.asarray(np.cumsum(toggles, axis=1) % 2, dtype=np.float64))


def _toggle(toggles: NDArray[np.int64], lines: tuple[Array, Array], loop: Array) -> None:
    """Count, in each row of cells, where one that goes to the right crosses a loop (k, 2)."""
    following = np.roll(loop, -1, axis=0)
    along = np.abs(following - loop)
    if np.any(along.min(axis=1) > SAME_LINE):
        raise SceneInvalid("The virtual camera draws areas with upright sides only.")
    for start, end in zip(loop, following, strict=True):
        if abs(start[1] - end[1]) > SAME_LINE:
            top, bottom = sorted(int(_nearest(lines[1], np.array([y]))[0]) for y in (start[1], end[1]))
            column = int(_nearest(lines[0], start[:1])[0])
            toggles[top + 1 : bottom + 1, column + 1] += 1


def _lines(values: Array) -> Array:
    ordered = np.sort(values)
    return ordered[np.r_[True, np.diff(ordered) > SAME_LINE]]


def _nearest(lines: Array, x: Array | Levels) -> NDArray[np.intp]:
    """Return the index of the line that is nearest to each x."""
    return np.asarray(np.searchsorted(0.5 * (lines[1:] + lines[:-1]), x))


def _blend(
    cells: tuple[Array, Array, Array, Array],
    beyond_u: Array | Levels,
    beyond_v: Array | Levels,
    both: Array | Levels,
) -> Array:
    """Return the mean of four cells by the shares beyond u's line, beyond v's and beyond both."""
    first, right, below, diagonal = cells
    mean: Array = (
        first
        + (right - first) * beyond_u
        + (below - first) * beyond_v
        + (first - right - below + diagonal) * both
    )
    return mean
