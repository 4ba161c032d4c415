import numpy as np
import pytest

from service.core.vision.board import is_larger, is_whole, order_corners, prominent_grids
from service.core.vision.corner_grid import CornerGrid
from service.core.vision.target_chessboard import Chessboard


def grid_of(rows: int, columns: int, phase: int = 0, step: float = 10.0) -> CornerGrid:
    y, x = np.mgrid[:rows, :columns].astype(np.float64)
    return CornerGrid(np.stack([x, y], axis=-1) * step, phase)


@pytest.mark.parametrize(
    ("rows", "columns", "larger"), [(6, 9, False), (9, 6, False), (7, 7, True), (3, 10, True), (5, 9, False)]
)
def test_a_grid_is_larger_when_the_target_cannot_show_it(rows: int, columns: int, larger: bool) -> None:
    assert is_larger(grid_of(rows, columns), Chessboard(9, 6, 1.0)) is larger


def test_a_grid_with_a_hole_is_not_whole() -> None:
    grid = grid_of(9, 6)
    assert is_whole(grid, Chessboard(9, 6, 1.0))
    grid.points[4, 4] = np.nan
    assert not is_whole(grid, Chessboard(9, 6, 1.0))


@pytest.mark.parametrize("turn", range(4))
@pytest.mark.parametrize("phase", [0, 1])
def test_the_first_corner_lies_by_a_dark_square_and_the_order_is_not_mirrored(turn: int, phase: int) -> None:
    upright = grid_of(6, 9, phase)
    points = np.rot90(upright.points, turn)
    # The colour of the cell that a turn brings to the front, in the grid that was not turned.
    front = [(0, 0), (0, 7), (4, 7), (4, 0)][turn]
    ordered, dark_first = order_corners(CornerGrid(points, (sum(front) + phase) % 2), Chessboard(9, 6, 1.0))
    expected = upright.points if phase == 0 else np.rot90(upright.points, 2)
    assert dark_first
    assert ordered.tolist() == expected.tolist()


def test_a_grid_that_another_one_dwarfs_is_left_out() -> None:
    large, small = grid_of(6, 9, step=30.0), grid_of(6, 9, step=6.0)
    assert prominent_grids([small, large]) == [large]


def test_no_grid_is_prominent_where_there_is_none() -> None:
    assert prominent_grids([]) == []
