import numpy as np
import pytest

from service.core.vision.corner_grid import CornerGrid
from service.core.vision.outer_lines import whole_lines, without_rims
from service.core.vision.sampling import smooth
from tests.core.vision.drawn_board import draw_board


def grid_of(rows: int, columns: int) -> CornerGrid:
    y, x = np.mgrid[:rows, :columns].astype(np.float64)
    return CornerGrid(np.stack([x, y], axis=-1) * 10.0, 0)


def test_a_row_of_which_one_corner_is_there_is_chance() -> None:
    grid = grid_of(7, 9)
    grid.points[0, 1:] = np.nan
    kept = whole_lines(grid)
    assert kept.points.shape[:2] == (6, 9)
    assert kept.phase == 1


def test_a_row_of_which_most_is_there_counts() -> None:
    grid = grid_of(7, 9)
    grid.points[0, 6:] = np.nan
    assert whole_lines(grid).points.shape[:2] == (7, 9)


@pytest.mark.parametrize("rows", [slice(0, 6), slice(0, 5), slice(1, 5)])
def test_lines_of_corners_are_no_rims(rows: slice) -> None:
    board = draw_board(roll_deg=10.0)
    grid = CornerGrid(board.corners.reshape(6, 9, 2)[rows], 0)
    assert without_rims(smooth(board.image(), 1.2), grid).points.shape == grid.points.shape


def test_a_line_along_the_rim_of_the_outer_squares_is_cut() -> None:
    board = draw_board(tilt=0.0)
    corners = board.corners.reshape(6, 9, 2)
    with_rim = np.concatenate([2 * corners[:1] - corners[1:2], corners])
    kept = without_rims(smooth(board.image(), 1.2), CornerGrid(with_rim, 1))
    assert kept.points.tolist() == corners.tolist()
    assert kept.phase == 0


def test_a_line_whose_outer_side_is_outside_the_image_is_kept() -> None:
    board = draw_board(8, 6, square_px=75.0, tilt=0.0, centre=(300.0, 260.0))
    grid = CornerGrid(board.corners.reshape(6, 8, 2), 0)
    assert without_rims(smooth(board.image(), 1.2), grid).points.shape == (6, 8, 2)
