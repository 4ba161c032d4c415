"""Which grid of a live frame is the board, and whether the rest may be spoken of as a part or a larger one.

Of two equal boards the larger in the picture counts, and a part of a near one hides a whole one far
behind, as on a capture. A perforated plate makes grids too: it looks even at a corner, where a chessboard is
midway between dark and bright; it goes on and on; and where it does not link as a whole, much else links
beside it.
Not here: how grids are found (`live_corners`, `corner_grid`).
"""

import numpy as np
from numpy.typing import NDArray

from service.core.vision.board import is_larger, nearest_whole, prominent_grids
from service.core.vision.corner_grid import CornerGrid
from service.core.vision.outer_lines import SHARE_OF_A_SURE_LINE, whole_lines
from service.core.vision.sampling import sample_bilinear
from service.core.vision.target import Target
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array

MIDWAY = 0.2  # of the contrast, from the middle of dark and bright to the level at a corner
SATURATED = 250.0  # grey level from which on a board's bright squares say nothing about its corners
LARGEST_BOARD = 4  # times the target's corners
LEAST_LARGEST = 150  # corners that a board may have at any rate
STRAY_CORNERS = 120  # beside a grid, from which on the frame is full of pattern


def choose_grid(grids: list[CornerGrid], target: Chessboard) -> CornerGrid:
    """Return the grid that is the target, else the one of which most is seen; an empty one of none."""
    nothing = CornerGrid(np.zeros((0, 0, 2)), 0)
    boards = [grid for grid in grids if not is_larger(whole_lines(grid), target)]
    whole = nearest_whole(prominent_grids(boards), target)
    if whole is not None:
        return whole
    return max(grids, key=lambda grid: int(grid.known.sum()), default=nothing)


def may_be_a_board(image: NDArray[np.uint8], grid: CornerGrid, corners_in_all: int, target: Target) -> bool:
    """Whether a grid that is not the whole target may be told as a part of a board or a larger one.

    image: (h, w) in which the grid was found; corners_in_all: of the frame, before they were linked.
    """
    seen = int(grid.known.sum())
    largest = max(LARGEST_BOARD * target.columns * target.rows, LEAST_LARGEST)
    return seen <= largest and corners_in_all - seen <= STRAY_CORNERS and is_midway_at_corners(image, grid)


def is_midway_at_corners(image: NDArray[np.uint8], grid: CornerGrid) -> bool:
    """Whether the levels at a grid's corners are about the mean of the dark and bright cells around them.

    True where bright cells are saturated or no corner has four cells.
    """
    p = grid.points
    middle = 0.25 * (p[:-1, :-1] + p[1:, :-1] + p[:-1, 1:] + p[1:, 1:])
    cells = _levels(image, middle)
    row, column = np.indices(cells.shape)
    sign = np.where((row + column + grid.phase) % 2 == 0, -1.0, 1.0)
    around = np.stack([cells[:-1, :-1], cells[1:, 1:], cells[:-1, 1:], cells[1:, :-1]])
    mean = around.mean(axis=0)
    contrast = 0.5 * sign[:-1, :-1] * (around[:2].sum(axis=0) - around[2:].sum(axis=0))
    away = np.abs(_levels(image, p[1:-1, 1:-1]) - mean) / np.maximum(contrast, 1.0)
    bright = cells[(sign > 0) & ~np.isnan(cells)]
    if np.isnan(away).all() or np.median(bright) >= SATURATED:
        return True
    return bool(np.nanmedian(away) <= MIDWAY)


def _levels(image: NDArray[np.uint8], points: Array) -> Array:
    """Grey levels at points (..., 2) px; NaN at those that are NaN."""
    known = ~np.isnan(points[..., 0])
    filled = np.where(known[..., None], points, 0.0)
    return np.where(known, sample_bilinear(image, filled[..., 0], filled[..., 1]), np.nan)


def is_sure_and_larger(grid: CornerGrid, target: Chessboard) -> bool:
    """Whether a grid shows a board with more rows or columns than the target, nearly whole ones."""
    return is_larger(whole_lines(grid, SHARE_OF_A_SURE_LINE), target)
