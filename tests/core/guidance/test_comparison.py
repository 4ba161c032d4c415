import numpy as np
import pytest

from service.core.guidance.comparison import (
    compare_pose,
    default_tolerances,
    is_match,
    match_share,
)
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector

TARGET = Chessboard(9, 6, 0.025)
CAMERA = Intrinsics.from_parameters(
    "pinhole5", {"fx": 1350.0, "fy": 1352.0, "cx": 650.0, "cy": 390.0, "k1": -0.37, "k2": 0.24}, (1280, 800)
)
TOLERANCES = default_tolerances((1280, 800))
TILTED = rotation_matrix(np.array([0.5, -0.3, 0.4]))


def held(centre: tuple[float, float, float], rotation: Array = TILTED) -> Pose:
    return Pose(rotation_vector(rotation), np.array(centre) - rotation @ TARGET.centre)


def turned(axis: int, degrees: float) -> Array:
    turn: Array = rotation_matrix(np.deg2rad(degrees) * np.eye(3)[axis]) @ TILTED
    return turn


EXPECTED = held((0.02, -0.01, 0.6))


@pytest.mark.parametrize(
    ("seen", "name", "value"),
    [
        (held((0.0, -0.01, 0.6)), "right_px", 45.0),
        (held((0.02, -0.03, 0.6)), "down_px", 45.0),
        (held((0.024, -0.012, 0.72)), "closer_share", 0.2),
        (held((0.02, -0.01, 0.6), turned(0, -20.0)), "tilt_rad", np.deg2rad(20.0)),
        (held((0.02, -0.01, 0.6), turned(1, -20.0)), "turn_rad", np.deg2rad(20.0)),
        (held((0.02, -0.01, 0.6), turned(2, -20.0)), "roll_rad", np.deg2rad(20.0)),
    ],
)
def test_one_error_of_a_tilted_board_is_that_error_alone(seen: Pose, name: str, value: float) -> None:
    difference = compare_pose(EXPECTED, seen, CAMERA, TARGET)
    assert getattr(difference, name) == pytest.approx(value, rel=0.03)
    for other in {"right_px", "down_px", "closer_share", "tilt_rad", "turn_rad", "roll_rad"} - {name}:
        assert getattr(difference, other) == pytest.approx(0.0, abs=1.0 if other.endswith("px") else 1e-6)
    assert not is_match(difference, TOLERANCES)


def test_what_leads_out_alone_may_stay_in_the_picture_by_half_or_with_another() -> None:
    """A board that must go left to the border and be turned upright: rolled as it is, it does not fit."""
    upright, rolled = rotation_matrix(np.zeros(3)), rotation_matrix(np.array([0.0, 0.0, 0.5]))
    wanted, seen = held((-0.21, 0.0, 0.6), upright), held((0.1, 0.0, 0.6), rolled)
    difference = compare_pose(wanted, seen, CAMERA, TARGET)
    assert difference.leads_out == (True, False, False, False, False, False)
    assert not difference.half_leads_out[0]
    assert difference.together_lead_out == {(0, i) for i in (1, 2, 3, 4)} | {(0, 1, i) for i in (2, 3, 4)}


def test_the_way_of_a_hand_is_in_metres_and_radians() -> None:
    ahead = compare_pose(held((0.0, 0.0, 0.5)), held((0.0, 0.0, 0.6)), CAMERA, TARGET)
    assert ahead.ways[2] == pytest.approx(0.1, rel=1e-6)
    beside = compare_pose(EXPECTED, held((0.0, -0.01, 0.6)), CAMERA, TARGET)
    assert beside.ways[:3] == pytest.approx((0.02, 0.0, 0.0), abs=2e-3)
    turn = compare_pose(EXPECTED, held((0.02, -0.01, 0.6), turned(1, 20.0)), CAMERA, TARGET)
    assert turn.ways[3:] == pytest.approx((0.0, np.deg2rad(20.0), 0.0), abs=1e-6)


@pytest.mark.parametrize(
    ("axis", "edge", "further"),
    [(0, (0, -1), False), (1, (-1, 0), True)],
)
def test_positive_tilt_brings_the_top_forward_and_positive_turn_takes_the_left_back(
    axis: int, edge: tuple[int, int], further: bool
) -> None:
    """What the drawing in the docstring says, in metres: the depth of the edge that is top or left now."""
    seen = held((0.0, 0.0, 0.6), np.eye(3))
    expected = held((0.0, 0.0, 0.6), rotation_matrix(np.deg2rad(15.0) * np.eye(3)[axis]))
    difference = compare_pose(expected, seen, CAMERA, TARGET)
    assert (difference.tilt_rad, difference.turn_rad)[axis] > 0
    point = TARGET.centre + 0.05 * np.array([*edge, 0.0])
    depths = [(pose.rotation @ point + pose.tvec)[2] for pose in (seen, expected)]
    assert (depths[1] > depths[0]) == further


def test_positive_roll_takes_the_right_edge_down_in_the_image() -> None:
    seen = held((0.0, 0.0, 0.6), np.eye(3))
    expected = held((0.0, 0.0, 0.6), rotation_matrix(np.array([0.0, 0.0, 0.2])))
    assert compare_pose(expected, seen, CAMERA, TARGET).roll_rad > 0
    right = [project(CAMERA, p.rotation, p.tvec, TARGET.object_points)[8] for p in (seen, expected)]
    assert right[1][1] > right[0][1] + 10


def test_corners_are_compared_by_the_papers_rule() -> None:
    seen = held((0.03, -0.02, 0.65), turned(2, 5.0))
    corners = [
        project(CAMERA, pose.rotation, pose.tvec, TARGET.object_points[[0, 8, 53, 45]])
        for pose in (EXPECTED, seen)
    ]
    expected_px = np.linalg.norm(corners[0] - corners[1], axis=1).mean()
    assert compare_pose(EXPECTED, seen, CAMERA, TARGET).corner_px == pytest.approx(expected_px)


@pytest.mark.parametrize("degrees", [180.0, 150.0, -130.0])
def test_a_board_turned_by_180_degrees_is_upside_down_and_never_matches(degrees: float) -> None:
    difference = compare_pose(EXPECTED, held((0.02, -0.01, 0.6), turned(2, degrees)), CAMERA, TARGET)
    assert difference.is_upside_down
    assert not is_match(difference, TOLERANCES)
    assert match_share(difference, TOLERANCES) == 0.0


def test_a_board_rotated_by_90_degrees_is_rotated_back_and_not_turned_round() -> None:
    assert not compare_pose(
        EXPECTED, held((0.02, -0.01, 0.6), turned(2, 90.0)), CAMERA, TARGET
    ).is_upside_down


def test_the_match_is_full_exactly_within_the_tolerances_and_tilt_counts_though_corners_hardly_move() -> None:
    near = compare_pose(EXPECTED, held((0.021, -0.01, 0.6)), CAMERA, TARGET)
    assert is_match(near, TOLERANCES)
    assert match_share(near, TOLERANCES) == 1.0
    facing = held((0.0, 0.0, 0.9), np.eye(3))
    tilted = held((0.0, 0.0, 0.9), rotation_matrix(np.array([np.deg2rad(20.0), 0.0, 0.0])))
    mistaken = compare_pose(facing, tilted, CAMERA, TARGET)
    assert mistaken.corner_px < TOLERANCES.corner_px
    assert not is_match(mistaken, TOLERANCES)
    assert 0.3 < match_share(mistaken, TOLERANCES) < 0.8


def test_tolerances_grow_with_the_image_and_corners_stay_within_2_percent_of_its_width() -> None:
    wide = default_tolerances((1920, 1208))
    assert wide.corner_px == pytest.approx(38.4)
    assert wide.offset_px == pytest.approx(45.0)


def test_mending_an_error_that_takes_a_corner_over_the_border_is_known() -> None:
    corner = held((-0.25, -0.11, 0.75), np.eye(3))
    near = held((0.0, 0.0, 0.3), np.eye(3))
    difference = compare_pose(corner, near, CAMERA, TARGET)
    assert difference.leads_out[0]
    assert not difference.leads_out[2]
