"""Grids of circles in rendered pictures: centres against the truth, their bias, refusals."""

from functools import lru_cache

import numpy as np
import pytest
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible, WrongTarget
from service.core.vision.board_map import fit_board_map
from service.core.vision.circle_centres import centroid_bias
from service.core.vision.detection import Detection, detect_target
from service.core.vision.target_circles import Circles, parse_circles
from service.core.vision.transforms import Array, Pose
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import clean_scene, production_scene, true_corners
from tests.simulator.cameras import LENS_1, centred_pose

GRID = parse_circles("circles:4x11:16mm:8mm")
LARGE = parse_circles("circles:4x11:16mm:16mm")
EVEN = parse_circles("circles:4x8:20mm:10mm")


@lru_cache(maxsize=8)
def scene_of(target: Circles, *, clean: bool = True) -> PreparedScene:
    make = clean_scene if clean else production_scene
    return prepare(make(LENS_1, target))


def picture(target: Circles, pose: Pose, *, clean: bool = True) -> NDArray[np.uint8]:
    return scene_of(target, clean=clean).render(pose, np.random.default_rng(5))


def errors(detection: Detection, target: Circles, pose: Pose) -> Array:
    return np.asarray(detection.image_points - true_corners(scene_of(target).scene, pose))


def rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


@pytest.mark.parametrize("roll", [0, 45, 90, 150, 180, 230, 270, 315])
def test_at_any_roll_each_dot_is_the_one_that_it_is_named(roll: int) -> None:
    pose = centred_pose(GRID, (15.0, -10.0, roll), (0.0, 0.0, 0.5))
    found = detect_target(picture(GRID, pose), GRID)
    assert found.corner_ids.tolist() == list(range(44))
    assert rms(errors(found, GRID, pose)) < 0.03


@pytest.mark.parametrize("degrees", [(45, 0, 0), (-45, 0, 30), (0, 45, 0), (0, -45, 200), (32, 32, 100)])
def test_tilted_grids_are_found_and_judged_bright_and_sharp(degrees: tuple[int, int, int]) -> None:
    pose = centred_pose(GRID, degrees, (0.0, 0.0, 0.5))
    found = detect_target(picture(GRID, pose, clean=False), GRID)
    assert rms(errors(found, GRID, pose)) < 0.03
    assert found.parity_separation > 0.5
    assert found.contrast > 100
    assert 1.0 < found.sharpness.edge_width_px < 3.0


def test_the_bias_of_centroids_is_known_and_taken_off() -> None:
    pose = centred_pose(LARGE, (30.0, 30.0, 60.0), (0.0, 0.0, 0.36))
    found = detect_target(picture(LARGE, pose), LARGE)
    bias = centroid_bias(
        fit_board_map(LARGE.object_points[:, :2], found.image_points, (np.array(found.image_size) - 1) / 2),
        LARGE,
    )

    assert rms(bias) > 0.2
    assert rms(errors(found, LARGE, pose)) < 0.2 * rms(bias)


def test_a_symmetric_grid_points_to_the_right() -> None:
    assert EVEN.is_symmetric
    for roll in (0, 60, 120, 180, 240):
        pose = centred_pose(EVEN, (10.0, 10.0, roll), (0.0, 0.0, 0.6))
        found = detect_target(picture(EVEN, pose), EVEN)
        assert found.image_points[3, 0] > found.image_points[0, 0]
        truth = true_corners(scene_of(EVEN).scene, pose)
        off = min(rms(found.image_points - truth), rms(found.image_points - truth[::-1]))
        assert off < 0.03


def test_a_part_of_a_grid_is_refused_with_how_much_was_seen() -> None:
    pose = centred_pose(GRID, (0.0, 0.0, 0.0), (0.0, 0.0, 0.5))
    image = picture(GRID, pose)
    image[:, 720:] = 120
    with pytest.raises(TargetNotVisible, match="Only") as refused:
        detect_target(image, GRID)
    assert 16 < int(str(refused.value.facts["corners_seen"])) < 44
    with pytest.raises(TargetNotVisible, match="No 4x11 grid"):
        detect_target(scene_of(GRID).background.astype(np.uint8), GRID)


@pytest.mark.parametrize("declared", ["circles:4x9:16mm:8mm", "circles:3x11:16mm:8mm"])
def test_a_larger_grid_than_declared_is_refused(declared: str) -> None:
    pose = centred_pose(GRID, (10.0, 15.0, -25.0), (0.0, 0.0, 0.5))
    with pytest.raises(WrongTarget, match="more dots"):
        detect_target(picture(GRID, pose), parse_circles(declared))
