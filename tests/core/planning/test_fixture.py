import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.core.errors import PoseSpaceEmpty
from service.core.planning.fixture import Box, plate_corners, touches_a_box
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.transforms import Array, rotation_matrix
from tests.core.planning.cameras import BOARD, LENS1

TABLE = Box((-1.0, 0.15, 0.0), (1.0, 0.5, 2.0))


def plate_points(R: Array, t: Array) -> Array:
    """A dense grid of points on the plate, camera frame."""
    corners = plate_corners(BOARD)
    u, v = np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60))
    on_plate = (
        corners[0] + u[..., None] * (corners[1] - corners[0]) + v[..., None] * (corners[3] - corners[0])
    )
    points: Array = on_plate.reshape(-1, 3) @ R.T + t
    return points


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(-1.2, 1.2), min_size=3, max_size=3),
    st.lists(st.floats(-0.3, 0.3), min_size=3, max_size=3),
)
def test_a_plate_touches_a_box_when_a_point_of_it_lies_inside(turn: list[float], shift: list[float]) -> None:
    R, t = rotation_matrix(np.array(turn)), np.array(shift)
    box = Box((-0.05, -0.04, -0.06), (0.05, 0.07, 0.04))
    points = plate_points(R, t)
    inside = np.all((points >= box.low_m) & (points <= box.high_m), axis=1).any()
    grown = np.all(
        (points >= np.array(box.low_m) - 0.006) & (points <= np.array(box.high_m) + 0.006), axis=1
    ).any()
    touching = touches_a_box((box,), BOARD, R[None], t[None])[0]
    assert touching or not inside
    assert grown or not touching


def test_no_sampled_plate_touches_the_fixture() -> None:
    poses = sample_poses(PoseSpace(excluded_boxes=(TABLE,)), LENS1, BOARD, 60, seed=1)
    for i in range(60):
        assert plate_points(poses.rotations[i], poses.translations[i])[:, 1].max() < 0.15


def test_a_fixture_that_leaves_no_room_is_named() -> None:
    everywhere = Box((-2.0, -2.0, 0.0), (2.0, 2.0, 2.0))
    with pytest.raises(PoseSpaceEmpty, match="excluded_boxes"):
        sample_poses(PoseSpace(excluded_boxes=(everywhere,)), LENS1, BOARD, 10, seed=1)


def test_every_corner_is_within_the_depth_of_field() -> None:
    poses = sample_poses(PoseSpace(depth_of_field_m=(0.35, 0.6)), LENS1, BOARD, 60, seed=1)
    depths = (BOARD.object_points @ np.swapaxes(poses.rotations, 1, 2) + poses.translations[:, None])[..., 2]
    assert depths.min() >= 0.35
    assert depths.max() <= 0.6


def test_a_depth_of_field_beyond_the_space_is_named() -> None:
    with pytest.raises(PoseSpaceEmpty, match="depth_of_field_m"):
        sample_poses(PoseSpace(distance_m=(0.3, 0.5), depth_of_field_m=(2.0, 3.0)), LENS1, BOARD, 10, seed=1)
