import numpy as np
import pytest

from service.core.planning.curve import CurvePoint, smallest_count
from service.core.planning.plan import PoseSet, plan_pose_set
from service.core.planning.pose_space import PoseSpace
from tests.core.planning.cameras import BOARD, LENS1


@pytest.fixture(scope="module")
def planned() -> PoseSet:
    return plan_pose_set(LENS1, BOARD, PoseSpace(), 6, seed=1, candidates=400, with_curve=True)


def test_the_curve_runs_from_three_poses_to_thirty_and_falls(planned: PoseSet) -> None:
    assert [point.poses for point in planned.curve] == list(range(3, 31))
    norms = np.array([point.norm_px for point in planned.curve])
    assert np.all(norms[1:] < 1.02 * norms[:-1])
    assert norms[-1] < 0.5 * norms[0]


def test_the_curve_promises_what_a_plan_of_as_many_poses_does(planned: PoseSet) -> None:
    at_six = planned.curve[3]
    assert at_six.mapping_mean_px == pytest.approx(planned.expected_mapping.mean_px, rel=0.15)
    assert at_six.mapping_worst_px == pytest.approx(planned.expected_mapping.worst_px, rel=0.3)


def test_the_curve_ends_where_no_more_poses_fit() -> None:
    space = PoseSpace(separation_px=330.0)
    crowded = plan_pose_set(LENS1, BOARD, space, 4, seed=1, candidates=200, with_curve=True)
    assert 4 <= len(crowded.curve) < 20


def test_the_smallest_number_is_the_first_that_is_good_enough() -> None:
    curve = [CurvePoint(n, 1.0, error, 2 * error) for n, error in ((3, 0.5), (4, 0.3), (5, 0.2))]
    assert smallest_count(curve, 0.3) == 4
    assert smallest_count(curve, 0.1) is None
