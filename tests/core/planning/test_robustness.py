import numpy as np
import pytest

from service.core.planning.candidates import sample_candidates
from service.core.planning.information import pose_information
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.planning.prediction import predict_accuracy, zone_within
from service.core.planning.robustness import Robustness, Slack, information_by_draw
from service.core.planning.scoring import expected_norm
from service.core.vision.tolerance import Tolerance
from tests.core.planning.cameras import BOARD, LENS1

SPACE = PoseSpace()
GIVEN = sample_candidates(LENS1, BOARD, SPACE, 60, 4, sigma_px=0.1)
POSES = GIVEN.poses
EXACT = Slack(0.0, 0.0, 0.0)
ALIKE = Tolerance(0.0, 0.0, 0.0, {})


def test_the_first_draw_is_the_nominal_camera_at_the_exact_poses() -> None:
    rng, three = np.random.default_rng(1), Robustness(draws=3)
    drawn = information_by_draw(LENS1, BOARD, GIVEN, robustness=three, rng=rng)
    np.testing.assert_allclose(drawn[0], pose_information(LENS1, BOARD, POSES, 0.1))
    assert drawn.shape == (3, 60, 9, 9)
    assert not np.allclose(drawn[1], drawn[0], rtol=1e-3)


@pytest.mark.parametrize("robustness", [Robustness(2, ALIKE, EXACT)])
def test_without_tolerance_and_slack_all_draws_are_alike(robustness: Robustness) -> None:
    drawn = information_by_draw(LENS1, BOARD, GIVEN, robustness=robustness, rng=np.random.default_rng(1))
    np.testing.assert_allclose(drawn[1], drawn[0], rtol=1e-9)


def test_a_robust_plan_costs_hardly_anything_at_the_nominal() -> None:
    plain, robust = (
        plan_pose_set(LENS1, BOARD, SPACE, 8, seed=1, candidates=600, robustness=robustness)
        for robustness in (Robustness(draws=1), Robustness(draws=5))
    )
    assert robust.draws == 5
    assert robust.expected_norm_px < 1.1 * plain.expected_norm_px


def test_noisier_poses_make_the_promise_of_a_set_worse_than_weighing_them_would() -> None:
    sigma = np.where(np.arange(60) % 2 == 0, 0.05, 0.4)
    promised = predict_accuracy(LENS1, BOARD, POSES, sigma, zone_within(LENS1.image_size, 12.0)).norm_px
    weighed = expected_norm(pose_information(LENS1, BOARD, POSES, sigma).sum(axis=0))
    assert promised > 1.5 * weighed
