from dataclasses import replace

import numpy as np
import pytest

from service.core.vision.corner_grid import CornerGrid
from service.core.vision.grid_growth import complete_grid, fill_grid, measure_steps, predict
from service.core.vision.live_corners import refine_on_pixels
from service.core.vision.sampling import smooth
from service.core.vision.transforms import Array
from tests.core.vision.drawn_board import draw_board

BOARD = draw_board(roll_deg=8.0)
BLURRED = smooth(BOARD.image(noise_grey=2.0), 1.2)
# The cell at corner 0 is dark, as is the one diagonally outside it.
WHOLE = CornerGrid(BOARD.corners.reshape(6, 9, 2), 0)


def without(grid: CornerGrid, *places: tuple[slice | int, slice | int]) -> CornerGrid:
    points = grid.points.copy()
    for place in places:
        points[place] = np.nan
    return replace(grid, points=points)


def largest_error_px(grid: CornerGrid, truth: Array) -> float:
    return float(np.linalg.norm(grid.points - truth, axis=-1).max())


@pytest.mark.parametrize(
    "hole",
    [(2, 3), (slice(2, 4), slice(3, 6)), (slice(None), 8), (0, slice(None)), (slice(None), slice(3, None))],
)
def test_missing_corners_are_found_again(hole: tuple[slice | int, slice | int]) -> None:
    grown = complete_grid(BLURRED, without(WHOLE, hole), rounds=9)
    assert grown.points.shape == (6, 9, 2)
    assert largest_error_px(grown, WHOLE.points) < 0.3


def test_a_gap_is_filled_corner_by_corner_and_nothing_beyond_it() -> None:
    washed_out = without(WHOLE, (slice(3), slice(3)))
    filled = fill_grid(BLURRED, washed_out, 3, refine_on_pixels)
    assert filled.points.shape == (6, 9, 2)
    assert largest_error_px(filled, WHOLE.points) < 0.5
    assert not fill_grid(BLURRED, washed_out, 1, refine_on_pixels).known.all()
    assert fill_grid(
        BLURRED, replace(WHOLE, points=WHOLE.points[:, 1:]), 3, refine_on_pixels
    ).known.shape == (6, 8)


def test_a_corner_in_the_wrong_place_is_put_right() -> None:
    points = WHOLE.points.copy()
    points[3, 4] += 12.0
    grown = complete_grid(BLURRED, replace(WHOLE, points=points), rounds=9)
    assert largest_error_px(grown, WHOLE.points) < 0.3


def test_nothing_grows_beyond_the_board() -> None:
    assert complete_grid(BLURRED, WHOLE, rounds=9).points.shape == (6, 9, 2)


def test_a_grid_whose_colours_are_the_other_way_round_is_not_proven() -> None:
    assert complete_grid(BLURRED, replace(WHOLE, phase=1), rounds=9).points.size == 0


def test_predictions_agree_with_the_corners_they_leave_out() -> None:
    assert np.linalg.norm(predict(WHOLE.points) - WHOLE.points, axis=-1).max() < 1.0


def test_the_square_is_the_smaller_height_of_its_parallelogram() -> None:
    steps = measure_steps(draw_board(square_px=36.0, tilt=0.0).corners.reshape(6, 9, 2))
    assert steps.square_px == pytest.approx(np.full((6, 9), 36.0), abs=1e-6)
