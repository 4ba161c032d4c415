from dataclasses import replace

import numpy as np
import pytest

from service.core.planning.noise import FITTED_NOISE, REFERENCE_BLUR_PX, blur_at, noise_at
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.planning.visibility import Visibility, measure_visibility
from service.core.vision.transforms import Array, rotation_matrix
from tests.core.planning.cameras import BOARD, LENS1

POSES = sample_poses(PoseSpace(), LENS1, BOARD, 200, seed=3)
SEEN = measure_visibility(LENS1, BOARD, POSES.rotations, POSES.translations)


def rolled(roll_deg: float) -> Visibility:
    R = rotation_matrix(np.deg2rad([[0.0, 0.0, roll_deg]]))
    return measure_visibility(LENS1, BOARD, R, np.array([[0.0, 0.0, 0.5]]) - R @ BOARD.centre)


def frontal(depths: list[float]) -> Visibility:
    R = np.broadcast_to(np.eye(3), (len(depths), 3, 3))
    centres: Array = np.array([(0.0, 0.0, z) for z in depths])
    return measure_visibility(LENS1, BOARD, R, centres - R @ BOARD.centre)


def test_a_number_is_the_noise_of_all_poses() -> None:
    np.testing.assert_array_equal(noise_at(0.1, SEEN), np.full(200, 0.1))


def test_the_level_scales_every_pose_alike() -> None:
    base, tenfold = (noise_at(FITTED_NOISE.at_level(level), SEEN) for level in (0.02, 0.2))
    np.testing.assert_allclose(tenfold, 10.0 * base)


def test_edges_along_the_pixel_grid_are_noisier() -> None:
    straight, turned = (float(noise_at(FITTED_NOISE, rolled(roll))[0]) for roll in (0.0, 45.0))
    assert straight > 1.1 * turned


def test_a_slanted_board_is_noisier() -> None:
    slanted = replace(SEEN, incidence_rad=np.full(200, np.deg2rad(55.0)))
    facing = replace(SEEN, incidence_rad=np.full(200, np.deg2rad(5.0)))
    assert np.all(noise_at(FITTED_NOISE, slanted) > noise_at(FITTED_NOISE, facing))


def test_blur_is_least_in_focus_and_alike_at_both_limits() -> None:
    focus = 2.0 / (1.0 / 0.3 + 1.0 / 0.9)
    blur = blur_at(frontal([0.3, focus, 0.9]), (0.3, 0.9))
    assert blur[1] == pytest.approx(REFERENCE_BLUR_PX)
    assert blur[0] == pytest.approx(blur[2])
    assert blur[0] == pytest.approx(np.hypot(REFERENCE_BLUR_PX, 1.0))


def test_without_a_depth_of_field_everything_is_in_focus() -> None:
    assert np.all(blur_at(SEEN, None) == REFERENCE_BLUR_PX)
