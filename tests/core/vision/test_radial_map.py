import numpy as np
import pytest

from service.core.vision.camera import Intrinsics, project
from service.core.vision.radial_map import RadialMap, fit_radial_map
from service.core.vision.target_circles import parse_circles
from service.core.vision.transforms import Array, Pose
from tests.simulator.cameras import LENS_1, centred_pose

DOTS = parse_circles("circles:4x7:30mm:15mm")
FEW = parse_circles("circles:3x3:60mm:20mm")
BOARD = DOTS.object_points[:, :2]
SIZE = np.array(LENS_1.image_size)
MIDDLE = (SIZE - 1.0) / 2.0
NEAR_AND_SLANTING = centred_pose(DOTS, (30.0, -25.0, 20.0), (0.0, 0.0, 0.45))


def seen(camera: Intrinsics, pose: Pose, board: Array) -> Array:
    flat = np.column_stack([board, np.zeros(len(board))])
    return project(camera, pose.rotation, pose.tvec, flat)


def fitted(board: Array, points: Array, middle: Array = MIDDLE, terms: int = 3) -> RadialMap:
    return fit_radial_map(board, points, middle, terms)


def off_px(camera: Intrinsics, board: Array = BOARD, between: Array | None = None) -> float:
    """The largest error of the map at places between the features it was fitted to."""
    places = 0.5 * (board[1:] + board[:-1]) if between is None else between
    found = fitted(board, seen(camera, NEAR_AND_SLANTING, board))
    return float(np.abs(found.image_of(places) - seen(camera, NEAR_AND_SLANTING, places)).max())


def test_perspective_and_distortion_together_are_followed() -> None:
    assert off_px(LENS_1) < 0.02


def test_so_is_a_lens_whose_axis_is_not_in_the_middle() -> None:
    parameters = {**LENS_1.parameters, "cx": LENS_1.parameters["cx"] + 25.0, "p1": 5e-4, "p2": -5e-4}
    assert off_px(Intrinsics.from_parameters("pinhole5", parameters, LENS_1.image_size)) < 0.05


def test_a_lens_without_distortion_leaves_the_centre_in_the_middle() -> None:
    parameters = {name: LENS_1.parameters[name] for name in ("fx", "fy", "cx", "cy")}
    camera = Intrinsics.from_parameters("pinhole5", parameters, LENS_1.image_size)
    noise = np.random.default_rng(2).normal(0.0, 0.02, (len(BOARD), 2))
    found = fitted(BOARD, seen(camera, NEAR_AND_SLANTING, BOARD) + noise)
    assert np.abs(found.centre).max() < 0.1
    assert np.abs(found.image_of(BOARD) - seen(camera, NEAR_AND_SLANTING, BOARD)).max() < 0.06


def test_few_features_do_with_one_radial_term() -> None:
    board = FEW.object_points[:, :2]
    wanted = seen(LENS_1, centred_pose(FEW, (20.0, 10.0, 0.0), (0, 0, 0.5)), board)
    found = fitted(board, wanted, terms=1)
    assert len(found.k) == 1
    assert np.abs(found.image_of(board) - wanted).max() < 0.2


@pytest.mark.parametrize("shift", [(0.0, 0.0), (-120.0, 75.0)])
def test_a_part_of_a_picture_has_the_same_map(shift: tuple[float, float]) -> None:
    points = seen(LENS_1, NEAR_AND_SLANTING, BOARD)
    whole = fitted(BOARD, points)
    part = fitted(BOARD, points + shift, MIDDLE + shift)
    assert part.image_of(BOARD) - shift == pytest.approx(whole.image_of(BOARD), abs=1e-6)
