from dataclasses import replace

import numpy as np
import pytest

from service.core.errors import PoseSetInfeasible
from service.core.planning.paper import (
    calibrate_noisy,
    plan_as_the_paper,
    sample_uniform_poses,
    score_random_sets,
)
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace, infeasibilities
from service.core.vision.camera import project
from tests.core.planning.cameras import BOARD, LENS1

SPACE = PoseSpace()


def test_uniform_poses_keep_the_bounds_and_come_from_the_generator() -> None:
    first, again = (sample_uniform_poses(SPACE, LENS1, BOARD, 60, np.random.default_rng(1)) for _ in range(2))
    assert len(first) == 60
    assert not np.any(list(infeasibilities(SPACE, LENS1, BOARD, first).values()))
    np.testing.assert_array_equal(first.translations, again.translations)


def test_a_space_without_room_is_refused() -> None:
    with pytest.raises(PoseSetInfeasible):
        sample_uniform_poses(
            replace(SPACE, distance_m=(5.0, 6.0)), LENS1, BOARD, 20, np.random.default_rng(1)
        )


def test_each_set_is_scored_by_the_papers_formula() -> None:
    rng = np.random.default_rng(2)
    poses = sample_uniform_poses(SPACE, LENS1, BOARD, 60, rng)
    scored = list(score_random_sets(LENS1, BOARD, poses, 8, rng, sets=4, alpha=2.0, beta=0.5))
    assert len(scored) == 4
    for one in scored:
        assert len(set(one.indices)) == 8
        assert one.score == pytest.approx(1.0 / (2.0 * one.mre_px + 0.5 * one.norm))
        # The mean length of a plane error of sd 0.1 px is 0.125 px; fitting takes a part of it.
        assert 0.08 < one.mre_px < 0.13


def test_a_draw_that_cannot_be_solved_is_none_and_scores_zero() -> None:
    poses = sample_uniform_poses(SPACE, LENS1, BOARD, 5, np.random.default_rng(3))
    pixels = project(LENS1, poses.rotations, poses.translations, BOARD.object_points)
    rng = np.random.default_rng(3)
    assert calibrate_noisy(LENS1, BOARD, pixels[:2], 0.1, rng) is None
    assert [one.score for one in score_random_sets(LENS1, BOARD, poses, 2, rng, sets=2)] == [0.0, 0.0]


def test_the_papers_plan_is_labelled_as_such_and_reports_what_it_really_promises() -> None:
    shares: list[float] = []
    theirs = plan_as_the_paper(
        LENS1, BOARD, SPACE, 8, 3, candidates=200, sets=12, sigma_px=0.1, progress=shares.append
    )
    ours = plan_pose_set(LENS1, BOARD, SPACE, 8, 3, candidates=200)
    assert (theirs.planner, theirs.objective) == ("paper-1", "score")
    assert len(theirs.poses) == 8
    assert shares[-1] == 1.0
    assert ours.expected_norm_px < theirs.expected_norm_px
    again = plan_as_the_paper(LENS1, BOARD, SPACE, 8, 3, candidates=200, sets=12)
    assert again.expected_norm_px == theirs.expected_norm_px
