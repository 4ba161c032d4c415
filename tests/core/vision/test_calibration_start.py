"""Starts of a solve: near the truth for narrow and wide lenses, and always one on which a solve can stand."""

import numpy as np
import pytest

from service.core.vision.blind_start import blind_start
from service.core.vision.calibration_start import nominal_start, planar_poses
from service.core.vision.camera import Intrinsics, unproject
from service.core.vision.normal_equations import is_feasible
from service.core.vision.transforms import angle_between
from service.core.vision.view_stack import stack_views
from tests.core.vision.cameras import ALL_ROUND, FISHEYE, LENS1, RATIONAL, WIDE, board_poses, views_of


@pytest.mark.parametrize("camera", [WIDE, ALL_ROUND], ids=lambda camera: camera.lens)
def test_homographies_give_the_poses_of_exact_corners(camera: Intrinsics) -> None:
    rotations, translations = board_poses(camera, 6, seed=6)
    stack = stack_views(views_of(camera, 6, seed=6, sigma_px=0.0))
    found_r, found_t = planar_poses(stack, unproject(camera, stack.image_points))
    assert float(angle_between(rotations, found_r).max()) < 1e-8
    np.testing.assert_allclose(found_t, translations, atol=1e-9)


@pytest.mark.parametrize(
    "camera",
    [LENS1, WIDE, RATIONAL, FISHEYE, ALL_ROUND],
    ids=["narrow", "wide", "rational", "fisheye", "200"],
)
def test_the_blind_start_is_near_for_narrow_and_for_wide_lenses(camera: Intrinsics) -> None:
    for seed in range(5):
        stack = stack_views(views_of(camera, 10, seed=20 + seed))
        start = blind_start(camera.lens, camera.image_size, stack)
        assert start is not None
        assert abs(start.vector[0] / camera.vector[0] - 1.0) < 0.2
        assert is_feasible(camera.lens, start, stack.object_points)


def test_a_nominal_that_folds_inside_the_picture_still_gives_a_start() -> None:
    stack = stack_views(views_of(WIDE, 10, seed=7))
    vector = WIDE.vector.copy()
    vector[4:] = -0.5, 0.0, 0.0, 0.0, 0.0
    start = nominal_start(Intrinsics.from_vector("pinhole5", vector, WIDE.image_size), stack)
    assert -0.5 < start.vector[4] <= 0.0
    assert is_feasible("pinhole5", start, stack.object_points)
