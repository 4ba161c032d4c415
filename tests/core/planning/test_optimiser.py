from itertools import combinations

import numpy as np
import pytest

from service.core.errors import PoseSetInfeasible
from service.core.planning.criterion import OBJECTIVES, PRESETS, make_criterion
from service.core.planning.information import pose_information
from service.core.planning.optimiser import corner_distances, select_poses
from service.core.planning.pose_space import Indices, PoseSpace, sample_poses
from service.core.planning.scoring import expected_covariance, expected_norm
from service.core.vision.camera import project
from service.core.vision.uncertainty import GRID, compensated_jacobian, whole_image
from tests.core.planning.cameras import BOARD, LENS1

POSES = sample_poses(PoseSpace(), LENS1, BOARD, 400, seed=11)
PIXELS = project(LENS1, POSES.rotations, POSES.translations, BOARD.object_points)
INFORMATION = pose_information(LENS1, BOARD, POSES, 0.1)
J = compensated_jacobian(LENS1, whole_image(LENS1.image_size).grid(*GRID))
NORM = make_criterion(PRESETS["parameters"], INFORMATION.mean(axis=0))


class Cancelled(Exception):
    pass


def norm_of(indices: Indices | list[int]) -> float:
    return expected_norm(INFORMATION[list(indices)].sum(axis=0))


def test_a_small_problem_is_solved_to_the_optimum_of_all_sets() -> None:
    some = np.arange(16)
    found = select_poses(INFORMATION[some], PIXELS[some], 3, 0.0, NORM, seed=1, starts=6)
    every = [INFORMATION[list(chosen)].sum(axis=0) for chosen in combinations(some, 3)]
    best = min(np.trace(np.linalg.inv(total)) for total in every)
    assert norm_of(found) == pytest.approx(np.sqrt(best), rel=1e-6)


def test_no_single_exchange_improves_the_result() -> None:
    found = list(select_poses(INFORMATION, PIXELS, 5, 0.0, NORM, seed=1))
    value = norm_of(found)
    for slot in range(5):
        rest = found[:slot] + found[slot + 1 :]
        assert min(norm_of([*rest, other]) for other in range(400) if other not in rest) > value * (1 - 1e-4)


def test_the_result_is_far_better_than_random_sets() -> None:
    rng = np.random.default_rng(1)
    random = [norm_of(rng.choice(400, 8, replace=False)) for _ in range(200)]
    assert norm_of(select_poses(INFORMATION, PIXELS, 8, 80.0, NORM, seed=1)) < 0.8 * min(random)


def test_chosen_poses_keep_their_distance_and_are_distinct() -> None:
    found = select_poses(INFORMATION, PIXELS, 10, 150.0, NORM, seed=1)
    assert len(set(found)) == 10
    for i, j in combinations(found, 2):
        assert corner_distances(PIXELS[[i, j]], 0)[1] >= 150.0


def test_separation_costs_accuracy_but_never_gains_it() -> None:
    free, apart = (norm_of(select_poses(INFORMATION, PIXELS, 8, px, NORM, seed=1)) for px in (0.0, 250.0))
    assert free < apart


def test_the_same_seed_gives_the_same_set() -> None:
    first, again = (select_poses(INFORMATION, PIXELS, 6, 80.0, NORM, seed=5) for _ in range(2))
    np.testing.assert_array_equal(first, again)


def test_each_objective_is_best_at_what_it_asks_for() -> None:
    norm, mean, worst = {}, {}, {}
    for objective in OBJECTIVES:
        criterion = make_criterion(PRESETS[objective], INFORMATION.mean(axis=0), J)
        found = select_poses(INFORMATION, PIXELS, 12, 80.0, criterion)
        covariance = expected_covariance(INFORMATION[found].sum(axis=0))
        variances = criterion.variances(covariance[None])[0]
        norm[objective], mean[objective] = np.trace(covariance), variances.mean()
        worst[objective] = variances.max()
    assert norm["parameters"] == min(norm.values())
    assert worst["worst"] == min(worst.values())
    assert mean["mapping"] < mean["parameters"]
    assert norm["balanced"] < 1.1 * norm["parameters"]
    assert mean["balanced"] < 1.1 * mean["mapping"]


def test_a_set_for_many_draws_is_better_on_average_than_one_for_a_single_draw() -> None:
    rng = np.random.default_rng(3)
    # Each draw knows some candidates better than another one does.
    draws = INFORMATION[None] * 10.0 ** rng.uniform(-2.0, 0.5, (6, len(INFORMATION), 1, 1))

    def mean_value(found: Indices) -> float:
        return float(np.mean([np.trace(expected_covariance(one[found].sum(axis=0))) for one in draws]))

    robust = select_poses(draws, PIXELS, 6, 80.0, NORM, seed=1)
    naive = select_poses(draws[:1], PIXELS, 6, 80.0, NORM, seed=1)
    assert mean_value(robust) < 0.9 * mean_value(naive)


def test_a_start_that_is_given_is_kept_or_bettered() -> None:
    given = [3, 40, 77, 150, 260, 390]
    found = select_poses(INFORMATION, PIXELS, 7, 0.0, NORM, starts=1, begin=given)
    assert len(set(found)) == 7
    assert norm_of(found) < norm_of(given)


def test_the_first_places_go_to_candidates_that_may_take_them() -> None:
    slots = [np.arange(400) == 17, np.arange(400) < 50]
    found = select_poses(INFORMATION, PIXELS, 5, 80.0, NORM, slots=slots)
    assert found[0] == 17
    assert found[1] < 50


def test_a_separation_that_no_set_keeps_is_refused_with_what_to_do() -> None:
    with pytest.raises(PoseSetInfeasible, match="separation_px"):
        select_poses(INFORMATION, PIXELS, 20, 900.0, NORM)


def test_progress_rises_to_one_and_its_exception_ends_the_search() -> None:
    shares: list[float] = []
    select_poses(INFORMATION, PIXELS, 5, 80.0, NORM, progress=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0

    def cancel(share: float) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        select_poses(INFORMATION, PIXELS, 5, 80.0, NORM, progress=cancel)
