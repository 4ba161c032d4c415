"""Pose of a flat target from one view: exact, mirrored tilts refused, bad input told."""

import cv2
import numpy as np
import pytest

from service.core.errors import PoseUndetermined
from service.core.vision.camera import Intrinsics, project
from service.core.vision.pose import estimate_pose
from service.core.vision.transforms import Array, angle_between, rotation_matrix
from tests.core.vision.cameras import ALL_ROUND, BOARD, FISHEYE, LENS1, RATIONAL, WIDE, board_poses


def tilted(degrees: float, depth: float) -> tuple[Array, Array]:
    R = rotation_matrix(np.array([0.0, np.radians(degrees), 0.0]))
    return R, np.array([0.02, 0.01, depth]) - R @ BOARD.centre


@pytest.mark.parametrize("camera", [LENS1, WIDE, RATIONAL, FISHEYE, ALL_ROUND])
def test_a_pose_comes_back_exactly_from_exact_corners(camera: Intrinsics) -> None:
    for R, t in zip(*board_poses(camera, 10, seed=1), strict=True):
        estimate = estimate_pose(camera, BOARD.object_points, project(camera, R, t, BOARD.object_points))
        assert estimate.rms_px < 1e-6
        assert float(angle_between(R, estimate.pose.rotation)) < 1e-8
        np.testing.assert_allclose(estimate.pose.tvec, t, atol=1e-8)


@pytest.mark.parametrize("degrees", [-28.0, -12.0, 12.0, 28.0])
def test_a_tilt_is_never_mirrored_at_working_distances(degrees: float) -> None:
    rng = np.random.default_rng(2)
    for depth in (0.3, 0.6, 1.0):
        R, t = tilted(degrees, depth)
        for _ in range(10):
            pixels = project(LENS1, R, t, BOARD.object_points) + 0.1 * rng.standard_normal((54, 2))
            estimate = estimate_pose(LENS1, BOARD.object_points, pixels)
            assert np.degrees(float(angle_between(R, estimate.pose.rotation))) < 1.0
            assert estimate.ambiguity < 0.5


def test_a_small_far_board_is_told_to_be_ambiguous() -> None:
    R, t = tilted(20.0, 12.0)
    rng = np.random.default_rng(3)
    pixels = project(LENS1, R, t, BOARD.object_points) + 0.3 * rng.standard_normal((54, 2))
    assert estimate_pose(LENS1, BOARD.object_points, pixels).ambiguity > 0.9


@pytest.mark.parametrize("number", [174, 213])
def test_a_wrong_focal_length_does_not_favour_the_wrong_tilt(number: int) -> None:
    vector = WIDE.vector * np.r_[1.25, 1.25, np.ones(7)]
    nominal = Intrinsics.from_vector(WIDE.lens, vector, WIDE.image_size)
    R, t = (part[number] for part in board_poses(WIDE, 300, seed=5))
    estimate = estimate_pose(nominal, BOARD.object_points, project(WIDE, R, t, BOARD.object_points))
    assert np.degrees(float(angle_between(R, estimate.pose.rotation))) < 25.0
    # The other tilt explains these corners better, through a lens that is not the one they were seen with.
    assert estimate.alternative_rms_px < estimate.rms_px
    assert estimate.ambiguity == 1.0


@pytest.mark.parametrize("growth", [0.8, 1.2])
def test_a_wrong_focal_length_is_found_with_the_pose_where_the_view_tells(growth: float) -> None:
    vector = WIDE.vector * np.r_[growth, growth, np.ones(7)]
    nominal = Intrinsics.from_vector(WIDE.lens, vector, WIDE.image_size)
    told = 0
    for R, t in zip(*board_poses(WIDE, 40, seed=6), strict=True):
        pixels = project(WIDE, R, t, BOARD.object_points)
        found = estimate_pose(nominal, BOARD.object_points, pixels)
        assert (found.freed is not None) == (found.rms_px > 1.0)
        # Where the view tells less, the focal length is held near the given one.
        if found.rms_px > 5.0 and found.freed is not None:
            pose, camera = found.freed
            told += 1
            assert abs(camera.camera_matrix[0, 0] / WIDE.camera_matrix[0, 0] - 1.0) < 0.04
            assert np.degrees(float(angle_between(R, pose.rotation))) < 2.0
    assert told > 5


def test_the_right_focal_length_is_taken_as_it_is() -> None:
    rng = np.random.default_rng(7)
    for R, t in zip(*board_poses(WIDE, 40, seed=7), strict=True):
        pixels = project(WIDE, R, t, BOARD.object_points) + rng.normal(
            0.0, 0.3, (len(BOARD.object_points), 2)
        )
        assert estimate_pose(WIDE, BOARD.object_points, pixels).freed is None


def test_the_refined_pose_is_no_worse_than_opencvs() -> None:
    rng = np.random.default_rng(4)
    for R, t in zip(*board_poses(WIDE, 8, seed=5), strict=True):
        pixels = project(WIDE, R, t, BOARD.object_points) + 0.2 * rng.standard_normal((54, 2))
        _, rvec, tvec = cv2.solvePnP(BOARD.object_points, pixels, WIDE.camera_matrix, WIDE.dist_coeffs)
        seen, _ = cv2.projectPoints(BOARD.object_points, rvec, tvec, WIDE.camera_matrix, WIDE.dist_coeffs)
        opencv = float(np.sqrt(np.mean(np.sum((pixels - seen[:, 0]) ** 2, axis=1))))
        assert estimate_pose(WIDE, BOARD.object_points, pixels).rms_px <= opencv + 1e-9


def test_a_part_of_the_board_gives_the_same_pose() -> None:
    R, t = tilted(20.0, 0.5)
    some = np.arange(0, 54, 5)
    pixels = project(LENS1, R, t, BOARD.object_points)[some]
    estimate = estimate_pose(LENS1, BOARD.object_points[some], pixels)
    np.testing.assert_allclose(estimate.pose.tvec, t, atol=1e-8)


def test_too_few_corners_are_told() -> None:
    with pytest.raises(PoseUndetermined) as caught:
        estimate_pose(LENS1, BOARD.object_points[:3], np.array([[600.0, 400], [650, 400], [700, 400]]))
    assert caught.value.facts == {"corners": 3}


def test_corners_on_one_line_are_told() -> None:
    row = BOARD.object_points[:9]
    pixels = np.stack([np.linspace(300, 900, 9), np.full(9, 400.0)], axis=-1)
    with pytest.raises(PoseUndetermined):
        estimate_pose(LENS1, row, pixels)
