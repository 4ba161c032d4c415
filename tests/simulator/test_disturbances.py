"""What makes a frame hard does what it says, and nothing to the rest of the picture."""

import numpy as np
import pytest

from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Pose
from service.simulator.disturbances import Holes, add_glare, occlude, perforate, put_behind, smear
from service.simulator.renderer import prepare
from service.simulator.scene import clean_scene, true_corners
from tests.simulator.cameras import BOARD, LENS_1, centred_pose


def spot() -> np.ndarray:
    light = np.zeros((41, 61))
    light[20, 30] = 1000.0
    return light


@pytest.mark.parametrize("path", [(6.0, 0.0), (0.0, 5.0), (4.0, -3.0), (0.3, 0.2)])
def test_a_smear_keeps_the_light_and_its_middle_and_spreads_it_along_the_path(
    path: tuple[float, float],
) -> None:
    smeared = smear(spot(), path)
    y, x = np.indices(smeared.shape)
    total = smeared.sum()
    assert total == pytest.approx(1000.0)
    assert (smeared * x).sum() / total == pytest.approx(30.0, abs=1e-6)
    assert (smeared * y).sum() / total == pytest.approx(20.0, abs=1e-6)
    # A line's variance, and what lies between pixels beside it.
    assert (smeared * (x - 30.0) ** 2).sum() / total == pytest.approx(path[0] ** 2 / 12, abs=0.3)
    assert (smeared * (y - 20.0) ** 2).sum() / total == pytest.approx(path[1] ** 2 / 12, abs=0.3)


def test_a_camera_at_rest_smears_nothing() -> None:
    assert np.array_equal(smear(spot(), (0.0, 0.0)), spot())


def test_glare_is_brightest_at_its_place_and_gone_far_from_it() -> None:
    glaring = add_glare(np.full((80, 100), 10.0), (70.0, 30.0), 5.0, 200.0)
    assert glaring[30, 70] == pytest.approx(210.0)
    assert glaring[30, 75] == pytest.approx(10.0 + 200.0 * np.exp(-0.5))
    assert glaring[70, 10] == pytest.approx(10.0)


def test_what_is_in_front_covers_its_outline_and_nothing_else() -> None:
    outline = np.array([[20.0, 10.0], [40.0, 10.0], [40.0, 30.0], [20.0, 30.0]])
    covered = occlude(np.full((60, 60), 100.0), outline, 7.0)
    assert covered[20, 30] == pytest.approx(7.0)
    assert covered[50, 30] == pytest.approx(100.0)


@pytest.mark.parametrize("staggered", [False, True])
def test_a_perforated_plate_is_as_open_as_its_holes(staggered: bool) -> None:
    holes = Holes(20.0, 12.0, staggered, plate_grey=1.0, hole_grey=0.0, turn_deg=17.0)
    cell = 20.0**2 * (np.sqrt(0.75) if staggered else 1.0)
    assert 1.0 - perforate((800, 600), holes).mean() == pytest.approx(np.pi * 36.0 / cell, abs=0.01)


def test_a_board_behind_is_seen_where_the_first_is_not() -> None:
    prepared = prepare(clean_scene(LENS_1, BOARD))
    other = Chessboard(7, 5, 0.025)
    front, behind = (
        centred_pose(BOARD, (0, 0, 0), (0.0, 0.0, 0.5)),
        centred_pose(other, (0, 0, 0), (0.2, 0, 1)),
    )
    both = put_behind(prepared, other, behind, gain=0.5)
    alone, light = prepared.light(front), both.light(front)
    x, y = true_corners(prepared.scene, front).mean(axis=0).astype(int)
    assert light[y, x] == alone[y, x]
    shown = put_behind(prepared, other, behind).light(Pose(np.zeros(3), np.array([50.0, 0.0, 1.0])))
    middle = LENS_1.vector[2:4] + LENS_1.vector[:2] * np.array([0.2, 0.0])
    around = np.s_[int(middle[1]) - 40 : int(middle[1]) + 40, int(middle[0]) - 20 : int(middle[0]) + 60]
    assert np.ptp(shown[around]) == pytest.approx(
        prepared.scene.white_grey - prepared.scene.dark_grey, rel=0.05
    )
