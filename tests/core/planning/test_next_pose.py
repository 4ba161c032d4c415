"""Which open pose comes first when the planned order cannot be kept."""

import numpy as np
import pytest

from service.core.planning.criterion import PRESETS, Criterion, make_criterion
from service.core.planning.information import pose_information
from service.core.planning.next_pose import choose_next_pose, information_gains
from service.core.planning.pose_space import Poses
from service.core.planning.prediction import zone_within
from service.core.vision.transforms import Array, stack_poses
from service.core.vision.uncertainty import GRID, compensated_jacobian
from tests.plant import pose_set, revision

SKU = revision()
POSES = Poses(*stack_poses(list(pose_set().poses)))
INFORMATION: Array = pose_information(SKU.intrinsics, SKU.target, POSES)
ALL = range(len(POSES))


def criterion() -> Criterion:
    zone = zone_within(SKU.intrinsics.image_size, 10.0)
    J = compensated_jacobian(SKU.intrinsics, zone.grid(*GRID))
    return make_criterion(PRESETS["balanced"], INFORMATION.mean(axis=0), J)


def worth(chosen: list[int]) -> float:
    return criterion().value(np.linalg.inv(INFORMATION[chosen].sum(axis=0))[None])


def test_gains_order_the_poses_as_the_criterion_itself_does() -> None:
    captured, candidates = [0, 2, 5, 6], [1, 3, 4, 7]
    gains = information_gains(INFORMATION, criterion(), captured, candidates)

    expected = [np.log(worth(captured) / worth([*captured, i])) for i in candidates]
    assert gains == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("captured", [[], [0], [0, 2, 5]])
def test_every_pose_helps(captured: list[int]) -> None:
    rest = [i for i in ALL if i not in captured]
    assert np.all(information_gains(INFORMATION, criterion(), captured, rest) > 0)


def test_a_pose_that_tells_nothing_new_is_not_chosen() -> None:
    poses = Poses(
        np.concatenate([POSES.rotations[:3], POSES.rotations[[0]]]),
        np.concatenate([POSES.translations[:3], POSES.translations[[0]]]),
    )
    information = np.concatenate([INFORMATION[:3], 1e-3 * INFORMATION[[0]]])
    chosen = choose_next_pose(
        poses, SKU.target, information, criterion(), captured=[0, 1], candidates=[2, 3], hand=None
    )
    assert chosen == 2


def test_of_two_poses_that_tell_as_much_the_nearer_one_is_chosen() -> None:
    twice = np.concatenate([INFORMATION[:1], np.repeat(INFORMATION[1:2], 2, axis=0)])
    for near, far in ((1, 2), (2, 1)):
        chosen = choose_next_pose(
            POSES[:3],
            SKU.target,
            twice,
            criterion(),
            captured=[0],
            candidates=[far, near],
            hand=POSES.pose(near),
        )
        assert chosen == near
