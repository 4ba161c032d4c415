import numpy as np
import pytest

from service.core.vision.light import fit_light, read_cells
from service.core.vision.parity import Parity, measure_parity
from service.core.vision.sampling import FloatImage, smooth
from service.core.vision.transforms import Array
from tests.core.vision.drawn_board import draw_board, to_image

BOARD = draw_board()
CORNERS = BOARD.corners.reshape(6, 9, 2)


def parity_of(image: FloatImage, corners: Array = CORNERS) -> Parity:
    cells = read_cells(image, corners)
    return measure_parity(cells, fit_light(cells))


def test_a_chessboard_separates_wholly() -> None:
    parity = parity_of(smooth(BOARD.image(), 1.0))
    assert parity.separation == pytest.approx(1.0, abs=0.03)
    assert parity.contrast == pytest.approx(165.0, abs=3.0)


def test_colours_the_other_way_round_are_negative() -> None:
    parity = parity_of(smooth(255 - BOARD.image(), 1.0))
    assert parity.separation < 0
    assert parity.contrast < -150.0


def test_a_gradient_of_light_does_not_lower_the_separation() -> None:
    light = BOARD.light() * np.linspace(1.2, 0.3, 480)[:, None]
    assert parity_of(smooth(to_image(light), 1.0)).separation > 0.9


def test_one_square_of_the_wrong_colour_shows() -> None:
    image = smooth(BOARD.image(), 1.0)
    x, y = CORNERS[2:4, 3:5].mean(axis=(0, 1)).astype(int)
    image[y - 12 : y + 12, x - 12 : x + 12] = 205.0 if image[y, x] < 120 else 40.0
    assert parity_of(image).separation < 0.3


def test_noise_is_no_chessboard() -> None:
    noise = np.random.default_rng(0).integers(0, 256, (480, 640)).astype(np.float32)
    assert parity_of(smooth(noise, 1.0)).separation < 0.2
