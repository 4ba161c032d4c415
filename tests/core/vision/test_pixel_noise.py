"""The noise of a picture is that of its sensor, whatever the picture shows."""

import numpy as np
import pytest

from service.core.vision.pixel_noise import noise_around
from tests.core.vision.drawn_board import draw_board


@pytest.mark.parametrize("noise_grey", [1.0, 3.0, 8.0])
def test_the_noise_of_a_drawn_board_is_measured_to_a_seventh(noise_grey: float) -> None:
    board = draw_board(square_px=44.0, white=180.0, dark=60.0)
    assert noise_around(board.image(noise_grey), board.corners) == pytest.approx(noise_grey, rel=0.15)


def test_a_ramp_has_no_noise() -> None:
    ramp = np.tile(np.arange(0, 200, 2, dtype=np.uint8), (60, 1))
    assert noise_around(ramp, np.array([[5.0, 5.0], [90.0, 50.0]])) == 0.0
