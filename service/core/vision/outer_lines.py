"""Which outermost rows and columns of a grid are lines of corners, and which are chance or the board's rim.

Where the board's white margin meets a dark background, a strong blur makes a row of points that pass for
corners. Beside a true line of corners the squares change places: what alternates dark and bright on its inner
side does so the other way round on its outer side. Beside a rim only the inner side alternates.
Not here: what size the board should have (`board`).
"""

import numpy as np

from service.core.vision.corner_grid import CornerGrid, crop
from service.core.vision.sampling import FloatImage, sample_bilinear
from service.core.vision.transforms import Array

SHARE_OF_A_LINE = 0.5  # of an outermost row or column that must be there for it to count as one
SHARE_OF_A_SURE_LINE = 0.8  # that must be there before a board is called another one
BESIDE = 0.22  # of a square: outer squares are often printed narrower than the others
LEAST_ALTERNATION = 0.4  # of the outer side against the inner one


def whole_lines(grid: CornerGrid, share: float = SHARE_OF_A_LINE) -> CornerGrid:
    """Return the grid without outer rows and columns of which less than a share of the corners is there."""
    while grid.points.size:
        known = grid.known
        lines = known[0], known[-1], known[:, 0], known[:, -1]
        shares = [np.count_nonzero(line) / len(line) for line in lines]
        side = shares.index(min(shares))
        if shares[side] >= share:
            return grid
        grid = _without(grid, side)
    return grid


def without_rims(blurred: FloatImage, grid: CornerGrid) -> CornerGrid:
    """Return the grid without outer rows and columns that are the rim of the board. blurred: (h, w)."""
    for side in range(4):
        if min(grid.points.shape[:2]) < 3:
            break
        if _is_rim(blurred, *_lines(grid, side)):
            grid = _without(grid, side)
    return grid


def _without(grid: CornerGrid, side: int) -> CornerGrid:
    """Cut the first row, the last row, the first column or the last column (side 0 to 3)."""
    rows, columns = grid.points.shape[:2]
    return crop(grid, side == 0, side == 2, rows - (side == 1), columns - (side == 3))


def _lines(grid: CornerGrid, side: int) -> tuple[Array, Array]:
    """The corners (n, 2) of the outermost line on a side, and of the line next to it."""
    p = grid.points
    return [(p[0], p[1]), (p[-1], p[-2]), (p[:, 0], p[:, 1]), (p[:, -1], p[:, -2])][side]


def _is_rim(blurred: FloatImage, line: Array, inner: Array) -> bool:
    """Whether the outer side of a line does not alternate as the inner one does; False if not to be seen."""
    middle = 0.5 * (line[:-1] + line[1:])
    outward = BESIDE * (middle - 0.5 * (inner[:-1] + inner[1:]))
    outside, inside = middle + outward, middle - outward
    height, width = blurred.shape
    # A place that is unknown (NaN) fails every comparison.
    seen = np.all((outside >= 0) & (outside <= np.array([width - 1, height - 1])) & (inside >= 0), axis=1)
    even, odd = seen & (np.arange(len(seen)) % 2 == 0), seen & (np.arange(len(seen)) % 2 == 1)
    if not even.any() or not odd.any():
        return False
    values = [sample_bilinear(blurred, *np.nan_to_num(side).T) for side in (outside, inside)]
    out, within = (float(side[even].mean() - side[odd].mean()) for side in values)
    return bool(-out * np.sign(within) < LEAST_ALTERNATION * abs(within))
