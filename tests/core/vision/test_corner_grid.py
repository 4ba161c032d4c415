import numpy as np

from service.core.vision.corner_candidates import Corners, find_corners
from service.core.vision.corner_grid import CornerGrid, keep_squares, link_corners, number_corners, trim
from tests.core.vision.drawn_board import draw_board


def corners_of_a_board(roll_deg: float = 10.0) -> Corners:
    return find_corners(draw_board(roll_deg=roll_deg).image())


def test_links_are_mutual() -> None:
    link = link_corners(corners_of_a_board())
    for corner, slot in np.argwhere(link >= 0):
        assert corner in link[link[corner, slot]]


def test_all_corners_of_a_board_are_numbered_in_one_grid() -> None:
    corners = corners_of_a_board()
    grid = number_corners(corners, link_corners(corners))[0]
    assert sorted(grid.points.shape[:2]) == [6, 9]
    assert grid.known.all()


def test_a_grid_is_never_mirrored_and_knows_its_dark_squares() -> None:
    for roll_deg in range(0, 360, 30):
        board = draw_board(square_px=30.0, roll_deg=roll_deg)
        corners = find_corners(board.image())
        grid = number_corners(corners, link_corners(corners))[0]
        x, y = grid.points[0, 1] - grid.points[0, 0], grid.points[1, 0] - grid.points[0, 0]
        assert x[0] * y[1] - x[1] * y[0] > 0
        column, row = grid.points[:2, :2].mean(axis=(0, 1)).astype(int)
        assert (board.image()[row, column] < 120) == (grid.phase % 2 == 0)


def test_a_corner_without_a_square_is_dropped() -> None:
    points = np.full((4, 5, 2), np.nan)
    points[1:3, 1:4] = 1.0
    points[0, 1] = points[3, 4] = 1.0
    kept = keep_squares(CornerGrid(points, 0))
    assert kept.points.shape[:2] == (2, 3)
    assert kept.phase == 0  # one row and one column were cut off


def test_trimming_an_empty_grid_gives_an_empty_grid() -> None:
    assert trim(CornerGrid(np.full((3, 4, 2), np.nan), 1)).points.shape == (0, 0, 2)


def test_no_corners_make_no_grid() -> None:
    corners = Corners(np.zeros((0, 2)), np.zeros((0, 4)), np.zeros(0))
    assert number_corners(corners, link_corners(corners)) == []
