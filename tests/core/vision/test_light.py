import numpy as np

from service.core.vision.light import even_out, fit_light, read_cells, saturated_share
from service.core.vision.sampling import smooth
from tests.core.vision.drawn_board import draw_board, to_image


def test_evened_light_has_dark_squares_at_0_and_bright_ones_at_1() -> None:
    board = draw_board()
    y, x = np.mgrid[:480, :640]
    falling = board.light() * (1.1 - ((x - 500) ** 2 + (y - 100) ** 2) / 6e5)
    blurred = smooth(to_image(falling), 1.0)
    corners = board.corners.reshape(6, 9, 2)
    even, origin = even_out(blurred, fit_light(read_cells(blurred, corners)), board.corners, margin_px=10)
    cells = read_cells(even, corners - origin)
    assert np.abs(cells.levels[cells.bright] - 1.0).max() < 0.06
    assert np.abs(cells.levels[~cells.bright]).max() < 0.06


def test_the_part_that_is_evened_stays_inside_the_image() -> None:
    board = draw_board(4, 3, square_px=110.0, tilt=0.0)
    blurred = smooth(board.image(), 1.0)
    cells = read_cells(blurred, board.corners.reshape(3, 4, 2))
    even, origin = even_out(blurred, fit_light(cells), board.corners, margin_px=1000)
    assert even.shape == (480, 640)
    assert origin.tolist() == [0.0, 0.0]


def test_few_cells_are_fitted_by_planes() -> None:
    board = draw_board(4, 3)
    light = fit_light(read_cells(smooth(board.image(), 1.0), board.corners.reshape(3, 4, 2)))
    assert not light.bright[3:].any()
    assert not light.dark[3:].any()


def test_the_saturated_share_is_that_of_the_bright_squares_only() -> None:
    board = draw_board(tilt=0.0)
    corners = board.corners.reshape(6, 9, 2)
    row, column = np.indices((5, 8))
    bright = (row + column) % 2 == 1
    image = board.image()
    glaring = np.full_like(image, 255)
    assert saturated_share(image, corners, bright) == 0.0
    assert saturated_share(glaring, corners, bright) == 1.0

    left = np.arange(image.shape[1]) < corners[:, 4, 0].mean()
    half = np.where((image > 128) & left, 255, image).astype(np.uint8)
    assert saturated_share(half, corners, bright) == 0.5
    assert saturated_share(half, corners, ~bright) < 0.02
