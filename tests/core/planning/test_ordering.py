from itertools import permutations

import numpy as np
import pytest

from service.core.planning.ordering import hand_times, order_poses, path_length
from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.vision.transforms import rotation_matrix
from tests.core.planning.cameras import BOARD, LENS1


def some_poses(count: int, seed: int) -> Poses:
    return sample_poses(PoseSpace(), LENS1, BOARD, count, seed)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_path_of_a_small_set_is_the_shortest_of_all(seed: int) -> None:
    poses = some_poses(7, seed)
    costs, order = hand_times(poses, BOARD), order_poses(poses, BOARD)
    others = [i for i in range(7) if i != order[0]]
    best = min(path_length(costs, [int(order[0]), *rest]) for rest in permutations(others))
    assert sorted(order) == list(range(7))
    assert path_length(costs, order) == pytest.approx(best)


def test_the_first_pose_is_the_least_turned() -> None:
    poses = some_poses(12, 4)
    assert order_poses(poses, BOARD)[0] == np.argmin(poses.turns())


def test_boards_along_a_line_are_taken_along_the_line() -> None:
    places = np.random.default_rng(3).permutation(25)
    rotations = np.tile(np.eye(3), (25, 1, 1))
    # The end of the line is the least turned, so that the path begins there.
    rotations[places != 0] = rotation_matrix(np.array([0.3, 0.0, 0.0]))
    centres = np.stack([0.1 * places, np.zeros(25), np.full(25, 0.5)], axis=1)
    order = order_poses(Poses(rotations, centres - rotations @ BOARD.centre), BOARD)
    np.testing.assert_array_equal(places[order], np.arange(25))


@pytest.mark.parametrize("count", [13, 20])
def test_a_large_set_has_no_two_poses_whose_exchange_shortens_the_path(count: int) -> None:
    poses = some_poses(count, 5)
    costs, order = hand_times(poses, BOARD), order_poses(poses, BOARD)
    length = path_length(costs, order)
    assert sorted(order) == list(range(count))
    for i in range(1, count):
        for j in range(i + 1, count):
            reversed_piece = np.concatenate([order[:i], order[i : j + 1][::-1], order[j + 1 :]])
            assert path_length(costs, reversed_piece) > length - 1e-9


def test_the_heuristic_finds_the_exact_path_where_both_can_be_had(monkeypatch: pytest.MonkeyPatch) -> None:
    for seed in range(5):
        poses = some_poses(10, 20 + seed)
        costs, exact = hand_times(poses, BOARD), order_poses(poses, BOARD)
        with monkeypatch.context() as patch:
            patch.setattr("service.core.planning.ordering.LARGEST_EXACT", 2)
            heuristic = order_poses(poses, BOARD)
        assert path_length(costs, heuristic) == pytest.approx(path_length(costs, exact), rel=0.02)


def test_times_are_symmetric_zero_at_home_and_count_way_and_turn() -> None:
    rotations = rotation_matrix(np.array([[0.0, 0.0, 0.0], [0.0, np.deg2rad(60.0), 0.0]]))
    centres = np.array([[0.0, 0.0, 0.5], [0.25, 0.0, 0.5]])
    times = hand_times(Poses(rotations, centres - rotations @ BOARD.centre), BOARD)
    np.testing.assert_allclose(times, [[0.0, 2.0], [2.0, 0.0]], atol=1e-12)


def test_one_pose_is_its_own_order() -> None:
    np.testing.assert_array_equal(order_poses(some_poses(1, 1), BOARD), [0])
