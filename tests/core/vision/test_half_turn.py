"""A symmetric target turned by half looks the same: its poses, orders and distances."""

import numpy as np
import pytest

from service.core.vision.half_turn import mean_distances, turn_by_half
from service.core.vision.target import parse_target
from service.core.vision.transforms import Pose

SYMMETRIC = pytest.mark.parametrize("spec", ["circles:4x8:20mm:10mm", "chessboard:8x6:25mm"])


@SYMMETRIC
def test_features_of_a_turned_pose_are_the_same_ones_backwards(spec: str) -> None:
    target = parse_target(spec)
    pose = Pose(np.array([0.3, -0.4, 2.0]), np.array([0.1, -0.05, 0.6]))
    turned = turn_by_half(pose, target)

    places = target.object_points @ pose.rotation.T + pose.tvec
    assert target.object_points @ turned.rotation.T + turned.tvec == pytest.approx(places[::-1])


@SYMMETRIC
def test_distances_are_those_of_the_nearer_order(spec: str) -> None:
    target = parse_target(spec)
    outer = target.object_points[list(target.outer_corners)][:, :2] * 1000.0
    other_end = target.object_points[::-1][list(target.outer_corners)][:, :2] * 1000.0
    wanted = np.stack([outer, other_end + np.array([3.0, 4.0])])

    assert mean_distances(outer, wanted, target) == pytest.approx([0.0, 5.0])


def test_a_board_that_tells_its_ends_apart_has_one_order() -> None:
    target = parse_target("circles:4x11:20mm:10mm")
    outer = target.object_points[list(target.outer_corners)][:, :2] * 1000.0

    assert mean_distances(outer, np.roll(outer, 2, axis=0)[None], target)[0] > 100.0
