import numpy as np
import pytest

from service.core.vision.board_map import fit_board_map, misfit_px
from service.core.vision.camera import Intrinsics, project
from service.core.vision.division_map import DivisionMap, fit_division_map
from service.core.vision.radial_map import RadialMap
from service.core.vision.transforms import Array, Pose
from tests.simulator.cameras import ALL_ROUND, BOARD, FISHEYE, LENS_1, LENS_2, centred_pose, varied_poses

FLAT = BOARD.object_points[:, :2]
BETWEEN = 0.5 * (FLAT[1:] + FLAT[:-1])
CAMERAS = {"lens 1": LENS_1, "lens 2": LENS_2, "fisheye": FISHEYE}


def middle_of(camera: Intrinsics) -> Array:
    return (np.array(camera.image_size) - 1.0) / 2.0


def seen(camera: Intrinsics, pose: Pose, board: Array = FLAT) -> Array:
    return project(camera, pose.rotation, pose.tvec, np.column_stack([board, np.zeros(len(board))]))


@pytest.mark.parametrize("name", CAMERAS)
def test_the_map_is_right_between_the_features_at_every_pose(name: str) -> None:
    camera = CAMERAS[name]
    off = [
        np.abs(
            fit_board_map(FLAT, seen(camera, pose), middle_of(camera)).image_of(BETWEEN)
            - seen(camera, pose, BETWEEN)
        ).max()
        for pose in varied_poses(camera)
    ]
    assert max(off) < 0.25
    assert np.median(off) < 0.02


def test_a_lens_near_its_fold_is_followed_by_radial_terms_and_a_fisheye_by_rays() -> None:
    folding, wide = varied_poses(LENS_2)[8], varied_poses(FISHEYE)[11]
    assert isinstance(fit_board_map(FLAT, seen(LENS_2, folding), middle_of(LENS_2)), RadialMap)
    assert isinstance(fit_board_map(FLAT, seen(FISHEYE, wide), middle_of(FISHEYE)), DivisionMap)


def test_rays_beyond_ninety_degrees_are_followed() -> None:
    pose = centred_pose(BOARD, (0.0, 75.0, 0.0), (0.09, 0.0, 0.015))
    depth = (BOARD.object_points @ pose.rotation.T + pose.tvec)[:, 2]
    assert depth.min() < 0.0 < depth.max()
    points = seen(ALL_ROUND, pose)
    found = fit_division_map(FLAT, points, middle_of(ALL_ROUND), 3)
    assert misfit_px(found, FLAT, points) < 0.1  # 130 degrees aside at the most


def test_noise_of_features_is_averaged() -> None:
    pose = varied_poses(FISHEYE)[9]
    truth = seen(FISHEYE, pose)
    noise = np.random.default_rng(3).normal(0.0, 0.1, truth.shape)
    found = fit_board_map(FLAT, truth + noise, middle_of(FISHEYE))
    # Thirteen numbers out of 108.
    assert np.sqrt(np.mean((found.image_of(FLAT) - truth) ** 2)) < 0.05


def test_few_features_do_with_one_term() -> None:
    few = FLAT[::6]
    pose = varied_poses(LENS_1)[2]
    found = fit_board_map(few, seen(LENS_1, pose, few), middle_of(LENS_1))
    assert isinstance(found, RadialMap | DivisionMap)
    assert len(found.k) == 1
    assert misfit_px(found, few, seen(LENS_1, pose, few)) < 0.1


def test_the_misfit_is_the_rms_distance() -> None:
    points = seen(LENS_1, varied_poses(LENS_1)[0])
    found = fit_board_map(FLAT, points, middle_of(LENS_1))
    assert misfit_px(found, FLAT, points + np.array([3.0, 4.0])) == pytest.approx(5.0, abs=0.01)
