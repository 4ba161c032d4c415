"""Is this grid the declared board, a larger one, or a part of it? In which order do its corners go?

Corner 0 has a dark square diagonally outside it, x runs along the columns, and the order is never mirrored.
Where a symmetric board leaves a choice, x points as far to the right in the image as it can.
Not here: what the image says about the squares (`parity`, `sharpness`).
"""

import cv2
import numpy as np

from service.core.errors import TargetNotVisible, WrongTarget
from service.core.vision.corner_grid import CornerGrid
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array

DWARFED = 0.2  # of the largest grid in area times corners
SHARE_OF_A_BOARD = 0.35  # of the corners that must be seen before a part of a board is spoken of


def prominent_grids(grids: list[CornerGrid]) -> list[CornerGrid]:
    """Return the grids that no other one dwarfs: a screen behind the board may show it again, small."""
    weights = [area(grid) * int(grid.known.sum()) for grid in grids]
    return [grid for grid, weight in zip(grids, weights, strict=True) if weight > DWARFED * max(weights)]


def area(grid: CornerGrid) -> float:
    """Return the area, px², that a grid's corners span."""
    if not grid.points.size:
        return 0.0
    return float(cv2.contourArea(cv2.convexHull(grid.points[grid.known].astype(np.float32))))


def is_larger(grid: CornerGrid, target: Chessboard) -> bool:
    """Whether a grid of whole lines has more rows or columns than the target can show."""
    rows, columns = grid.points.shape[:2]
    few, many = sorted((target.columns, target.rows))
    return bool(max(rows, columns) > many or min(rows, columns) > few)


def has_size(grid: CornerGrid, target: Chessboard) -> bool:
    """Whether a grid of whole lines has as many as the target."""
    return sorted(grid.points.shape[:2]) == sorted((target.columns, target.rows))


def is_whole(grid: CornerGrid, target: Chessboard) -> bool:
    """Whether a grid of whole lines is the target, each corner of it."""
    return has_size(grid, target) and bool(grid.known.all())


def nearest_whole(grids: list[CornerGrid], target: Chessboard) -> CornerGrid | None:
    """Return the grid that is the whole target, of several the largest in the picture."""
    whole = [grid for grid in grids if is_whole(grid, target)]
    return max(whole, key=area) if whole else None


def order_corners(grid: CornerGrid, target: Chessboard) -> tuple[Array, bool]:
    """Return a whole board's corners (rows, columns, 2) px in the target's order, and whether its rule holds.

    The rule, a dark square outside corner 0, cannot hold on a symmetric board that is printed with bright
    corners.
    """
    turned = [np.rot90(grid.points, turn) for turn in range(4)]
    dark = [_cell_is_dark(grid, turn) for turn in range(4)]
    fitting = [turn for turn in range(4) if turned[turn].shape[:2] == (target.rows, target.columns)]
    best = max(fitting, key=lambda turn: (dark[turn], _rightward(turned[turn])))
    return np.ascontiguousarray(turned[best]), dark[best]


def _cell_is_dark(grid: CornerGrid, turn: int) -> bool:
    """Whether the first cell is dark (as is the one diagonally outside) after quarter turns by `np.rot90`."""
    rows, columns = grid.points.shape[:2]
    row, column = [(0, 0), (0, columns - 2), (rows - 2, columns - 2), (rows - 2, 0)][turn]
    return bool((row + column + grid.phase) % 2 == 0)


def _rightward(points: Array) -> float:
    """The cosine of the angle between the x axis (of the first to the last column) and the image's."""
    axis = (points[:, -1] - points[:, 0]).mean(axis=0)
    return float(axis[0] / max(np.hypot(*axis), 1e-9))


def refuse_larger(grid: CornerGrid, target: Chessboard) -> WrongTarget:
    """The error that names the board that is there instead of the declared one."""
    rows, columns = sorted(grid.points.shape[:2], reverse=target.rows > target.columns)
    return WrongTarget(
        f"The board in the image has {columns}x{rows} inner corners, but {target.columns}x{target.rows} was "
        f"declared; declare chessboard:{columns}x{rows} or show the declared board.",
        found_columns=columns,
        found_rows=rows,
        declared_columns=target.columns,
        declared_rows=target.rows,
    )


def refuse_partial(corners_seen: int, target: Chessboard) -> TargetNotVisible:
    """The error that says how much of the board was seen and what to do."""
    needed = target.columns * target.rows
    name = f"{target.columns}x{target.rows} chessboard"
    if corners_seen < max(8, SHARE_OF_A_BOARD * needed):
        detail = (
            f"No {name} was found; bring the whole board into the picture, lit evenly, sharp and near enough."
        )
    elif corners_seen >= needed:
        detail = (
            f"More corners were found than a {name} has, but not clearly enough to say which board it is; "
            "take the picture again, sharper and with nothing patterned touching the board."
        )
    else:
        detail = (
            f"Only {corners_seen} of {needed} corners of the {name} were found; bring the whole board into "
            "the picture, uncovered and without reflections, and check that it is the declared one."
        )
    return TargetNotVisible(detail, corners_seen=corners_seen, corners_needed=needed)
