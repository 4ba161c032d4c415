"""Poses explained, against the definitions they are explained by."""

import numpy as np
import pytest

from service.core.planning.information import pose_information
from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.planning.prediction import predict_accuracy
from service.core.planning.review import (
    losses_without,
    outline_points,
    pitch_yaw_roll,
    review_poses,
)
from service.core.vision.camera import project
from service.core.vision.transforms import rotation_matrix
from service.core.vision.uncertainty import Region, parameter_metric
from tests.core.planning.cameras import BOARD, LENS1

POSES = sample_poses(PoseSpace(), LENS1, BOARD, 12, seed=3)
ZONE = Region(200.0, 120.0, 1080.0, 680.0)


def test_angles_make_the_rotation_as_the_pose_space_does() -> None:
    angles = pitch_yaw_roll(POSES.rotations)

    pitch, yaw, roll = (
        rotation_matrix(angles[:, i, None] * np.eye(3)[axis]) for i, axis in enumerate((0, 1, 2))
    )
    np.testing.assert_allclose(yaw @ pitch @ roll, POSES.rotations, atol=1e-12)
    assert np.ptp(np.rad2deg(angles), axis=0).min() > 20


def test_a_board_that_faces_the_camera_has_no_angles() -> None:
    facing = Poses(np.eye(3)[None], np.array([[-0.1, -0.0625, 0.5]]))

    (pose,) = review_poses(LENS1, BOARD, facing)

    assert (pose.tilt_deg, pose.pitch_deg, pose.yaw_deg, pose.roll_deg) == (0, 0, 0, 0)
    np.testing.assert_allclose(pose.centre_m, [0, 0, 0.5], atol=1e-12)
    assert pose.distance_m == pytest.approx(0.5)
    # The pattern has 10 x 7 squares of 25 mm.
    np.testing.assert_allclose(np.ptp(pose.plate_corners_m, axis=0), [0.25, 0.175, 0], atol=1e-12)
    assert pose.smallest_square_px == pytest.approx(0.025 * 1350 / 0.5, rel=0.05)


def test_an_outline_goes_through_the_outermost_corners_and_bends_with_the_lens() -> None:
    outline = outline_points(BOARD)
    outer = BOARD.object_points[list(BOARD.outer_corners)]

    assert len(outline) == 2 * 2 * (8 + 5)
    np.testing.assert_allclose(outline[[0, 16, 26, 42]], outer, atol=1e-12)
    pose = review_poses(LENS1, BOARD, POSES)[0]
    ends = project(LENS1, POSES.rotations[0], POSES.translations[0], outer)
    np.testing.assert_allclose(pose.outline_px[[0, 16, 26, 42]], ends, atol=1e-9)
    side = pose.outline_px[:17]
    along = (side[-1] - side[0]) / np.linalg.norm(side[-1] - side[0])
    assert np.abs((side - side[0]) @ np.array([-along[1], along[0]])).max() > 1.0


def test_the_plate_lies_in_the_boards_plane() -> None:
    for pose in review_poses(LENS1, BOARD, POSES):
        normal = pose.rotation[:, 2]
        assert np.ptp(pose.plate_corners_m @ normal) < 1e-12
        np.testing.assert_allclose(pose.plate_corners_m.mean(axis=0), pose.centre_m, atol=1e-12)


def test_a_loss_is_what_the_prediction_of_the_others_says() -> None:
    free = np.array([0, 1, 2, 3, 4, 5, 6, 7])
    losses = losses_without(pose_information(LENS1, BOARD, POSES, 0.1), parameter_metric(LENS1, ZONE), free)

    whole, rest = (
        predict_accuracy(LENS1, BOARD, poses, 0.1, ZONE, fixed=("k3",)).mapping.mean_px
        for poses in (POSES, POSES[[i for i in range(12) if i != 4]])
    )
    assert losses[4] == pytest.approx(rest / whole - 1, rel=1e-6)
    assert all(loss is not None and loss > 0 for loss in losses)


def test_a_pose_that_cannot_be_spared_has_no_loss() -> None:
    tilted, facing = POSES[[0]], Poses(np.eye(3)[None], np.array([[-0.1, -0.0625, 0.5]]))
    rotations = np.concatenate([tilted.rotations, facing.rotations, facing.rotations, facing.rotations])
    shifts = np.array([[0, 0, 0], [0, 0, 0], [0.02, 0, 0], [0, 0.03, 0]])
    translations = np.concatenate([tilted.translations, *[facing.translations] * 3]) + shifts
    poses = Poses(rotations, translations)

    losses = losses_without(
        pose_information(LENS1, BOARD, poses, 0.1), parameter_metric(LENS1, ZONE), np.arange(9)
    )

    assert losses[0] is None
    assert all(loss is not None for loss in losses[1:])
