from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from service.core.errors import IntrinsicsInvalid, PoseSetInfeasible
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import Poses, PoseSpace, infeasibilities
from service.core.planning.prediction import predict_accuracy, zone_within
from service.core.planning.variety import FAR_SHARE
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, project
from service.core.vision.transforms import stack_poses
from service.core.vision.uncertainty import Region, mapping_error
from tests.core.planning.cameras import BOARD, LENS1, LENS2

SPACE = PoseSpace()


class Cancelled(Exception):
    pass


@pytest.mark.parametrize(("count", "norm_px"), [(5, 0.90), (10, 0.61), (20, 0.48)])
def test_lens1_reaches_the_figures_of_the_design(count: int, norm_px: float) -> None:
    planned = plan_pose_set(LENS1, BOARD, SPACE, count, seed=1, candidates=3000, sigma_px=0.1)
    assert planned.expected_norm_px <= norm_px


@pytest.mark.parametrize(
    ("intrinsics", "centre_px", "mean_px", "worst_px"),
    [(LENS1, 0.7, 0.30, 1.0), (LENS2, 0.8, 0.40, 1.3)],
    ids=["lens1", "lens2"],
)
@pytest.mark.parametrize("seed", [1, 2])
def test_twelve_default_poses_promise_what_the_gates_ask_for(
    intrinsics: Intrinsics, centre_px: float, mean_px: float, worst_px: float, seed: int
) -> None:
    planned = plan_pose_set(intrinsics, BOARD, SPACE, 12, seed)
    sd = planned.expected_sd
    assert max(sd["fx"], sd["fy"]) / intrinsics.vector[0] <= 0.0010 / 2
    assert max(sd["cx"], sd["cy"]) <= centre_px
    assert planned.expected_mapping.mean_px <= mean_px
    assert planned.expected_mapping.worst_px <= worst_px
    # The hull covers a rectangle of 85 % of a central zone easily where it covers 60 % of the whole image.
    assert planned.diversity.coverage >= 0.60


def test_every_pose_is_feasible_and_apart_and_the_set_is_varied() -> None:
    planned = plan_pose_set(LENS2, BOARD, SPACE, 12, seed=3, candidates=1000)
    poses = Poses(*stack_poses(planned.poses))
    assert not np.any(list(infeasibilities(SPACE, LENS2, BOARD, poses).values()))
    pixels = project(LENS2, poses.rotations, poses.translations, BOARD.object_points)
    for a, b in combinations(pixels, 2):
        assert np.linalg.norm(a - b, axis=1).mean() >= SPACE.separation_px
    distances = np.linalg.norm(poses.centres(BOARD), axis=1)
    assert np.count_nonzero(distances >= 0.625) >= int(FAR_SHARE * 12)
    assert min(planned.diversity.pitch_spread_deg, planned.diversity.yaw_spread_deg) > 30.0
    assert planned.diversity.distance_ratio > 2.0


def test_the_first_pose_is_one_that_anyone_can_hit() -> None:
    planned = plan_pose_set(LENS1, BOARD, SPACE, 6, seed=3, candidates=1000)
    assert np.rad2deg(np.linalg.norm(planned.poses[0].rvec)) <= 20.0


def test_the_same_arguments_give_the_same_set() -> None:
    first, again = (plan_pose_set(LENS1, BOARD, SPACE, 5, seed=9, candidates=300) for _ in range(2))
    for a, b in zip(first.poses, again.poses, strict=True):
        np.testing.assert_array_equal(a.rvec, b.rvec)
        np.testing.assert_array_equal(a.tvec, b.tvec)
    assert first.expected_norm_px == again.expected_norm_px


@pytest.mark.parametrize("intrinsics", [LENS1, LENS2], ids=["lens1", "lens2"])
def test_the_predicted_scatter_is_the_scatter_of_the_solver(intrinsics: Intrinsics) -> None:
    planned = plan_pose_set(intrinsics, BOARD, SPACE, 8, seed=2, candidates=500, sigma_px=0.1)
    pixels = project(intrinsics, *stack_poses(planned.poses), BOARD.object_points)
    rng = np.random.default_rng(6)
    solved = []
    for _ in range(50):
        noisy = pixels + rng.normal(0.0, 0.1, pixels.shape)
        views = [View(BOARD.object_points, points) for points in noisy]
        result = calibrate_intrinsics(views, intrinsics.image_size, nominal=intrinsics)
        solved.append(result.intrinsics.vector)
    predicted = np.array(list(planned.expected_sd.values()))
    # The sd of 50 draws scatters by 10 %: 35 % is more than three times that.
    np.testing.assert_allclose(np.std(solved, axis=0) / predicted, 1.0, atol=0.35)


def test_fixed_parameters_have_no_uncertainty_and_leave_the_others_more_certain() -> None:
    fixed = ("k3", "p1", "p2")
    free, held = (plan_pose_set(LENS1, BOARD, SPACE, 5, seed=1, candidates=300, fixed=f) for f in ((), fixed))
    assert all(held.expected_sd[name] == 0.0 for name in fixed)
    assert held.expected_norm_px < free.expected_norm_px
    with pytest.raises(IntrinsicsInvalid, match="k9"):
        plan_pose_set(LENS1, BOARD, SPACE, 5, seed=1, candidates=300, fixed=("k9",))


def test_the_mapping_is_promised_for_the_zone_that_was_asked_for() -> None:
    zone = Region(320.0, 200.0, 960.0, 600.0)
    planned = plan_pose_set(LENS1, BOARD, SPACE, 5, seed=1, candidates=300, zone=zone)
    poses = Poses(*stack_poses(planned.poses))
    prediction = predict_accuracy(LENS1, BOARD, poses, 0.1, zone)
    expected = mapping_error(LENS1, prediction.covariance, zone)
    assert planned.expected_mapping.mean_px == pytest.approx(expected.mean_px)
    assert planned.expected_mapping.worst_px == pytest.approx(expected.worst_px)
    whole = predict_accuracy(LENS1, BOARD, poses, 0.1, zone_within(LENS1.image_size, 0.0))
    assert planned.expected_mapping.mean_px < whole.mapping.mean_px


def test_twice_the_noise_is_twice_the_error() -> None:
    small, large = (
        plan_pose_set(LENS1, BOARD, SPACE, 5, seed=1, candidates=300, sigma_px=s) for s in (0.1, 0.2)
    )
    assert large.expected_norm_px == pytest.approx(2.0 * small.expected_norm_px, rel=1e-6)


@pytest.mark.parametrize("bound", ["yaw_deg", "pitch_deg"])
def test_a_space_without_tilt_about_one_axis_is_refused_by_name(bound: str) -> None:
    flat = replace(SPACE, roll_deg=(0.0, 0.0), **{bound: (0.0, 0.0)})  # type: ignore[arg-type]
    with pytest.raises(PoseSetInfeasible, match=bound):
        plan_pose_set(LENS1, BOARD, flat, 6, seed=1, candidates=300)


def test_a_space_without_any_tilt_is_refused() -> None:
    parallel = replace(SPACE, yaw_deg=(0.0, 0.0), pitch_deg=(0.0, 0.0))
    with pytest.raises(PoseSetInfeasible):
        plan_pose_set(LENS1, BOARD, parallel, 6, seed=1, candidates=300)


def test_one_distance_is_enough_when_boards_are_tilted() -> None:
    fixture = replace(SPACE, distance_m=(0.4, 0.4))
    assert plan_pose_set(LENS1, BOARD, fixture, 8, seed=1, candidates=300).expected_norm_px < 2.0


@pytest.mark.parametrize(("count", "candidates"), [(2, 300), (0, 300), (10, 5)])
def test_too_few_poses_or_candidates_are_refused(count: int, candidates: int) -> None:
    with pytest.raises(PoseSetInfeasible):
        plan_pose_set(LENS1, BOARD, SPACE, count, seed=1, candidates=candidates)


def test_progress_rises_to_one_and_its_exception_ends_the_planning() -> None:
    shares: list[float] = []
    plan_pose_set(LENS1, BOARD, SPACE, 4, seed=1, candidates=300, progress=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0

    def cancel(share: float) -> None:
        if share > 0.4:
            raise Cancelled

    with pytest.raises(Cancelled):
        plan_pose_set(LENS1, BOARD, SPACE, 4, seed=1, candidates=300, progress=cancel)
