import numpy as np
import pytest

from service.core.vision.sharpness import Sharpness, measure_sharpness
from tests.core.vision.drawn_board import DrawnBoard, draw_board

GAUSSIAN_10_90 = 2.563  # widths of sigma


def sharpness_of(board: DrawnBoard, noise_grey: float = 0.0) -> Sharpness:
    corners = board.corners.reshape(board.target.rows, board.target.columns, 2)
    return measure_sharpness(board.image(noise_grey).astype(np.float32), corners)


@pytest.mark.parametrize("sigma_px", [1.2, 2.0, 3.0])
@pytest.mark.parametrize("roll_deg", [0.0, 33.0])
def test_the_width_of_a_gaussian_edge_is_measured(sigma_px: float, roll_deg: float) -> None:
    sharpness = sharpness_of(draw_board(sigma_px=sigma_px, roll_deg=roll_deg))
    assert sharpness.edge_width_px == pytest.approx(GAUSSIAN_10_90 * sigma_px, rel=0.1)


def test_sampling_between_pixels_widens_a_sharp_edge_by_a_sixth() -> None:
    assert sharpness_of(draw_board(sigma_px=0.8)).edge_width_px == pytest.approx(
        1.16 * GAUSSIAN_10_90 * 0.8, rel=0.04
    )


def test_noise_widens_an_edge_only_little() -> None:
    sharpness = sharpness_of(draw_board(sigma_px=1.0), noise_grey=5.0)
    assert sharpness.edge_width_px == pytest.approx(GAUSSIAN_10_90, rel=0.15)


def test_quadrants_are_those_of_the_image() -> None:
    board = draw_board(square_px=20.0, centre=(160.0, 130.0))
    tl, tr, br, bl = sharpness_of(board).quadrants_px
    assert tl == pytest.approx(2.05, rel=0.15)
    assert np.isnan([tr, br, bl]).all()


def test_a_quadrant_that_is_softer_shows() -> None:
    board = draw_board(square_px=55.0)
    soft = DrawnBoard(board.target, board.homography, sigma_px=2.4).image().astype(np.float32)
    image = board.image().astype(np.float32)
    image[:240, 320:] = soft[:240, 320:]
    tl, tr, br, bl = measure_sharpness(image, board.corners.reshape(6, 9, 2)).quadrants_px
    assert tr > 2.0 * max(tl, br, bl)


def test_the_centre_is_the_middle_half_of_the_image() -> None:
    board = draw_board(square_px=20.0, centre=(110.0, 90.0))
    assert np.isnan(sharpness_of(board).centre_px)
    assert np.isfinite(sharpness_of(draw_board()).centre_px)


def test_an_even_picture_has_no_edge_width() -> None:
    corners = draw_board().corners.reshape(6, 9, 2)
    assert np.isnan(measure_sharpness(np.full((480, 640), 90, np.float32), corners).edge_width_px)
