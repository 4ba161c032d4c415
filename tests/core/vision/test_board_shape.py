"""Shapes of plates, learnt from computed corners of many runs."""

import numpy as np
import pytest

from service.core.errors import DegenerateViews
from service.core.quality.board_drift import DriftState, compare_shapes, measure_certainty
from service.core.quality.evidence import Expectation, NamedDetection
from service.core.quality.gates import Verdict
from service.core.quality.verdict import calibrate_and_judge
from service.core.vision.board_shape import BoardShape, ShapeRun, estimate_board_shape, solve_run
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, project
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array
from service.core.vision.view_stack import stack_views
from tests.core.quality.seen_views import BOARD, NOMINAL, POSES, judge, measured, see

POINTS = BOARD.object_points
X, Y = (POINTS[:, axis] / POINTS[:, axis].max() - 0.5 for axis in (0, 1))
SIGMA_PX = 0.1
IDS = tuple(np.arange(len(POINTS)) for _ in POSES)


def bent(bow_mm: float, twist_mm: float = 0.0) -> Array:
    """Deviations (n, 3), m, of a plate with a bow along its columns and a twist, peak to peak."""
    heights = bow_mm * X**2 / np.ptp(X**2) + twist_mm * X * Y / np.ptp(X * Y)
    return np.outer(1e-3 * heights, [0.0, 0.0, 1.0])


def take_runs(deviations: Array, count: int, seed: int = 1) -> list[tuple[Intrinsics, ShapeRun]]:
    """Return cameras of a SKU and what they see of a plate."""
    rng = np.random.default_rng(seed)
    runs = []
    for _ in range(count):
        camera = draw_camera(NOMINAL, Tolerance(), rng)
        points = [
            project(camera, pose.rotation, pose.tvec + rng.uniform(-0.003, 0.003, 3), POINTS + deviations)
            + rng.normal(0.0, SIGMA_PX, (len(POINTS), 2))
            for pose in POSES
        ]
        runs.append((camera, ShapeRun(IDS, tuple(points), NOMINAL)))
    return runs


def learn(deviations: Array, count: int = 6) -> BoardShape:
    return estimate_board_shape(POINTS, [run for _, run in take_runs(deviations, count)])


def focal_bias(deviations: Array, taken_for: Array) -> tuple[float, float]:
    """Return the mean error of fx over eight new cameras that see a plate, and the sd of one, px."""
    errors, sds = [], []
    for camera, run in take_runs(deviations, 8, seed=2):
        views = [View(POINTS + taken_for, points) for points in run.image_points]
        found = calibrate_intrinsics(views, NOMINAL.image_size, nominal=NOMINAL)
        errors.append(found.intrinsics.vector[0] - camera.vector[0])
        sds.append(found.sd["fx"])
    return float(np.mean(errors)), float(np.mean(sds))


@pytest.mark.parametrize("deviations", [bent(0.3), bent(0.0, 0.3)], ids=["bowed", "twisted"])
def test_a_plate_is_learnt_to_a_hundredth_of_a_millimetre_and_no_longer_moves_the_focal_length(
    deviations: Array,
) -> None:
    shape = learn(deviations)
    heights = shape.deviations[:, 2] - deviations[:, 2]
    heights = heights - np.mean(heights)
    assert np.sqrt(np.mean(heights**2)) < 1e-5
    assert np.sqrt(np.mean(shape.deviations[:, :2] ** 2)) < 1e-5
    assert 0.28e-3 < shape.bend_m < 0.34e-3
    assert shape.sigma_px < 1.05 * SIGMA_PX < 1.3 * SIGMA_PX < shape.sigma_flat_px
    # The sd are those of the error that was made.
    assert 0.6 < np.sqrt(np.mean(heights**2)) / np.sqrt(np.mean(shape.sd[:, 2] ** 2)) < 1.6

    before, _ = focal_bias(deviations, np.zeros_like(POINTS))
    after, sd = focal_bias(deviations, shape.deviations)
    assert abs(after) < 0.7 * sd
    assert abs(before) > abs(after)


def test_what_a_shape_leaves_uncertain_is_what_cameras_have_in_common() -> None:
    shape = learn(bent(0.3), count=3)
    ((_, run),) = take_runs(bent(0.3), 1, seed=3)
    found = measure_certainty(POINTS, shape, run, solve_run(POINTS + shape.deviations, run))
    assert found.suits(0.1)
    assert not found.suits(4.0 * found.corner_mm)
    assert 0.0 < found.mapping_px < found.focal_px < found.centre_px < 1.0
    # To first order a shape that is off by its own draw moves the camera as much.
    rng = np.random.default_rng(1)
    off = (np.linalg.cholesky(shape.covariance + 1e-16 * np.eye(162)) @ rng.standard_normal(162)).reshape(
        -1, 3
    )
    moved = solve_run(POINTS + shape.deviations + off, run).intrinsics.vector
    shift = np.abs(moved - solve_run(POINTS + shape.deviations, run).intrinsics.vector)
    assert shift[:2].max() < 4.0 * found.focal_px
    assert shift[2:4].max() < 4.0 * found.centre_px


def test_a_flat_plate_is_found_flat_and_a_larger_one_is_not_told_from_a_nearer_one() -> None:
    shape = learn(0.01 * POINTS, count=3)
    assert np.abs(shape.deviations).max() < 5e-5
    assert shape.bend_m < 5e-5


def test_partial_views_count() -> None:
    deviations = bent(0.3)
    runs = [run for _, run in take_runs(deviations, 4)]
    half = np.arange(len(POINTS))[POINTS[:, 0] <= 0.125]
    parts = [
        ShapeRun((half, *run.corner_ids[1:]), (run.image_points[0][half], *run.image_points[1:]), run.nominal)
        for run in runs
    ]
    shape = estimate_board_shape(POINTS, parts)
    assert 0.28e-3 < shape.bend_m < 0.35e-3


def judge_with(points: list[Array], board: Array | None) -> tuple[Verdict, float]:
    views: list[NamedDetection] = [see(one, f"{i:02d}.png") for i, one in enumerate(points)]
    told = Expectation(NOMINAL, poses=POSES, pose_of_view=tuple(range(len(points))))
    judged = calibrate_and_judge(views, BOARD, expectation=told, board=board)
    bias = measured(judged, "bias_ratio")
    assert bias.value is not None
    return bias.verdict, bias.value


def test_a_run_with_the_learnt_shape_passes_where_the_flat_one_fails_and_a_plate_that_curls_fails() -> None:
    shape = learn(bent(0.5))
    ((_, same),) = take_runs(bent(0.5), 1, seed=5)
    ((_, curled),) = take_runs(bent(1.2), 1, seed=5)
    board = POINTS + shape.deviations
    assert judge_with(list(same.image_points), None)[0] is Verdict.FAIL
    assert judge_with(list(same.image_points), board)[0] is Verdict.PASS
    assert judge_with(list(curled.image_points), board)[0] is Verdict.FAIL


def test_drift_is_told_in_millimetres_and_in_what_it_does_to_a_camera() -> None:
    certified, later = bent(0.1), bent(0.3)
    ((camera, run),) = take_runs(later, 1)
    views = [View(POINTS + later, points) for points in run.image_points]
    result = calibrate_intrinsics(views, NOMINAL.image_size, nominal=NOMINAL)
    moved = np.linalg.norm(later - certified, axis=1).max()

    drift = compare_shapes(POINTS, certified, later, run, result, limit_mm=0.25)
    assert drift.worst_mm == pytest.approx(1e3 * moved)
    assert drift.state is DriftState.STEADY if 1e3 * moved < 0.2 else DriftState.NEAR
    assert compare_shapes(POINTS, certified, later, run, result, limit_mm=0.1).state is DriftState.OVER
    assert compare_shapes(POINTS, later, later, run, result, limit_mm=0.1).worst_mm == 0.0

    wrong = calibrate_intrinsics(
        [View(POINTS + certified, points) for points in run.image_points], NOMINAL.image_size, nominal=NOMINAL
    )
    seen = np.abs(wrong.intrinsics.vector - result.intrinsics.vector)[:2].max()
    assert drift.focal_px == pytest.approx(seen, rel=0.05)
    assert camera.vector[0] > 0.0


def test_corners_far_off_the_plane_are_no_plate() -> None:
    view = View(POINTS + bent(20.0), project(NOMINAL, POSES[0].rotation, POSES[0].tvec, POINTS))
    with pytest.raises(DegenerateViews, match="nearly flat"):
        stack_views([view, view, view])


def test_without_a_shape_the_target_is_taken_as_it_is_meant() -> None:
    ((_, run),) = take_runs(np.zeros_like(POINTS), 1)
    views = [see(points, f"{i:02d}.png") for i, points in enumerate(run.image_points)]
    plain = judge(views)
    told = calibrate_and_judge(views, BOARD, board=POINTS)
    assert np.array_equal(plain.result.covariance, told.result.covariance)
