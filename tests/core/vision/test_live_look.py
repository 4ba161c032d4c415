"""Sharpness and brightness of a board, estimated from a few samples of a half-size frame."""

import numpy as np
import pytest

from service.core.vision.live_look import measure_look
from tests.core.vision.drawn_board import draw_board


@pytest.mark.parametrize("sigma_px", [0.7, 1.0, 2.0, 3.0])
def test_the_edge_width_follows_the_blur(sigma_px: float) -> None:
    board = draw_board(sigma_px=sigma_px, roll_deg=12.0)
    look = measure_look(board.image(1.0), board.corners.reshape(6, 9, 2), dark_first=True)
    assert look.edge_width_px == pytest.approx(2.563 * sigma_px, rel=0.25)


def test_an_edge_sharper_than_a_pixel_has_no_negative_width() -> None:
    board = draw_board(sigma_px=0.05)
    assert (
        0.0
        <= measure_look(board.image(), board.corners.reshape(6, 9, 2), dark_first=True).edge_width_px
        < 1.0
    )


def test_brightness_is_that_of_the_bright_squares_whichever_comes_first() -> None:
    board = draw_board(white=150.0, dark=20.0)
    corners = board.corners.reshape(6, 9, 2)
    assert measure_look(board.image(), corners, dark_first=True).brightness == pytest.approx(150.0, abs=1.0)
    assert measure_look(board.image(), corners, dark_first=False).brightness == pytest.approx(20.0, abs=1.0)


def test_a_board_without_contrast_has_a_finite_width() -> None:
    board = draw_board()
    flat = np.full((480, 640), 80, np.uint8)
    assert np.isfinite(measure_look(flat, board.corners.reshape(6, 9, 2), dark_first=True).edge_width_px)


def test_glare_is_the_share_of_the_bright_squares_that_is_saturated() -> None:
    board = draw_board(white=180.0)
    corners = board.corners.reshape(6, 9, 2)
    even = board.image()
    spoilt = even.copy()
    x = int(corners[:, 4, 0].mean())
    spoilt[:, :x] = 255

    assert measure_look(even, corners, dark_first=True).glare_share == 0.0
    assert measure_look(spoilt, corners, dark_first=True).glare_share == pytest.approx(0.5, abs=0.15)
