"""Under hard conditions a live frame shows the board in order, a part of it, or nothing; never another."""

from functools import cache

import numpy as np
import pytest

from bench.detection import LENS1, TARGET
from bench.guidance_rates import empty_frame, judge_one, random_plate, rate_random_poses
from bench.hard_frames import conditions, shot_of
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.corner_candidates import find_corners
from service.core.vision.corner_grid import link_corners, number_corners
from service.core.vision.detection import detect_target
from service.core.vision.live_choice import is_midway_at_corners
from service.core.vision.live_detection import LiveWorkspace, detect_live
from service.core.vision.transforms import Pose
from service.simulator.disturbances import Holes, perforate
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene
from tests.core.vision.drawn_board import draw_board, to_image

SEED = 23


@cache
def scene() -> PreparedScene:
    return prepare(production_scene(LENS1, TARGET, seed=SEED))


@cache
def poses() -> list[Pose]:
    space = PoseSpace(distance_m=(0.4, 0.8), roll_deg=(-180.0, 180.0))
    sampled = sample_poses(space, LENS1, TARGET, 3, SEED)
    return [sampled.pose(i) for i in range(3)]


@pytest.mark.parametrize("name", list(conditions(TARGET)))
def test_each_condition_is_told_as_what_it_is(name: str) -> None:
    condition, rng, workspace = conditions(TARGET)[name], np.random.default_rng(SEED), LiveWorkspace()
    for pose in poses():
        shot = shot_of(scene(), pose, rng)
        found = detect_live(condition.draw(shot), TARGET, workspace)
        assert judge_one(found, shot.truth)[0] in condition.right


def test_a_capture_takes_the_same_of_two_equal_boards() -> None:
    condition, rng = conditions(TARGET)["equal_board_behind"], np.random.default_rng(SEED)
    shot = shot_of(scene(), poses()[0], rng)
    errors = np.linalg.norm(detect_target(condition.draw(shot), TARGET).image_points - shot.truth, axis=1)
    assert errors.max() < 0.3


def test_random_boards_are_found_in_order() -> None:
    workspace = LiveWorkspace()
    row = rate_random_poses(scene(), lambda image: detect_live(image, TARGET, workspace), 12, SEED)
    assert (row["rate"], row["wrong"]) == (1.0, 0)


def test_nothing_is_seen_in_empty_frames_and_perforated_plates() -> None:
    rng, workspace = np.random.default_rng(SEED), LiveWorkspace()
    for number in range(12):
        assert detect_live(empty_frame(scene(), number, SEED, rng), TARGET, workspace).kind == "absent"
    for _ in range(12):
        plate = to_image(random_plate((640, 400), rng) + rng.normal(0.0, 2.0, (400, 640)))
        assert detect_live(plate, TARGET, workspace).kind == "absent"


def test_a_plate_is_even_at_its_corners_and_a_board_is_midway() -> None:
    board = draw_board(square_px=30.0, roll_deg=20.0)
    plate = to_image(perforate((640, 480), Holes(14.0, 10.0, turn_deg=20.0)))
    for image, midway in ((board.image(2.0), True), (plate, False)):
        corners = find_corners(image, limit=3000)
        grid = number_corners(corners, link_corners(corners))[0]
        assert is_midway_at_corners(image, grid) is midway
