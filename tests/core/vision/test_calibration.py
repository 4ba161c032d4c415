"""The solve against known truth, against OpenCV, and against what makes solvers fail silently."""

import cv2
import numpy as np
import pytest

from service.core.errors import DegenerateViews, IntrinsicsInvalid, TooFewViews
from service.core.vision.calibration import CalibrationResult, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, project
from service.core.vision.transforms import rotation_matrix
from service.core.vision.uncertainty import mapping_difference, whole_image
from service.core.vision.view_stack import View
from tests.core.vision.cameras import BOARD, LENS1, WIDE, views_of


def off_by(camera: Intrinsics, share: float) -> Intrinsics:
    vector = camera.vector * np.r_[1 + share, 1 + share, 1, 1, np.full(5, 1 - share)]
    return Intrinsics.from_vector(camera.lens, vector, camera.image_size)


def solve_with_opencv(views: list[View], camera: Intrinsics) -> tuple[float, np.ndarray, np.ndarray]:
    criteria = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 500, 1e-15)
    boards = [view.object_points.astype(np.float32) for view in views]
    corners = [view.image_points.astype(np.float32) for view in views]
    K, k = np.zeros((3, 3)), np.zeros(5)
    rms, _, _, _, _, sd, _, _ = cv2.calibrateCameraExtended(
        boards, corners, camera.image_size, K, k, criteria=criteria
    )
    vector = np.r_[K[0, 0], K[1, 1], K[0, 2], K[1, 2], k]
    return float(rms), vector, np.asarray(sd)[:9, 0]


@pytest.mark.parametrize("camera", [LENS1, WIDE])
@pytest.mark.parametrize("with_nominal", [True, False])
def test_exact_corners_give_the_exact_camera(camera: Intrinsics, with_nominal: bool) -> None:
    nominal = off_by(camera, 0.05) if with_nominal else None
    result = calibrate_intrinsics(views_of(camera, 8, 1, sigma_px=0.0), camera.image_size, nominal=nominal)
    assert result.converged
    np.testing.assert_allclose(result.intrinsics.vector, camera.vector, rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize("camera", [LENS1, WIDE])
def test_noisy_corners_give_the_camera_within_its_own_deviations(camera: Intrinsics) -> None:
    squared = []
    for seed in range(6):
        result = calibrate_intrinsics(
            views_of(camera, 12, seed), camera.image_size, nominal=off_by(camera, 0.05)
        )
        assert result.converged
        assert result.sigma_px == pytest.approx(0.1, rel=0.1)
        squared.append(((result.intrinsics.vector - camera.vector) / list(result.sd.values())) ** 2)
    assert 0.5 < np.mean(squared) < 1.8
    assert np.max(squared) < 16.0


@pytest.mark.parametrize("camera", [LENS1, WIDE])
def test_the_optimum_and_the_deviations_are_opencvs(camera: Intrinsics) -> None:
    views = [
        View(view.object_points, view.image_points.astype(np.float32).astype(np.float64))
        for view in views_of(camera, 12, seed=3)
    ]
    result = calibrate_intrinsics(views, camera.image_size)
    rms, vector, sd = solve_with_opencv(views, camera)
    np.testing.assert_allclose(result.intrinsics.vector[:4], vector[:4], atol=1e-3)
    assert result.rms_px == pytest.approx(rms, abs=1e-6)
    np.testing.assert_allclose(list(result.sd.values()), sd, rtol=1e-2)


def test_a_start_far_off_ends_at_the_same_camera() -> None:
    views = views_of(WIDE, 12, seed=4)
    near = calibrate_intrinsics(views, WIDE.image_size, nominal=WIDE)
    far = calibrate_intrinsics(views, WIDE.image_size, nominal=off_by(WIDE, 0.3))
    assert near.converged
    assert far.converged
    assert mapping_difference(near.intrinsics, far.intrinsics, whole_image(WIDE.image_size)).max() < 1e-2


def test_both_starts_are_reported() -> None:
    views = views_of(LENS1, 8, seed=5)
    names = [start.name for start in calibrate_intrinsics(views, LENS1.image_size, nominal=LENS1).starts]
    assert names == ["nominal", "blind"]
    assert [start.name for start in calibrate_intrinsics(views, LENS1.image_size).starts] == [
        "sweep",
        "blind",
    ]


def test_views_of_unequal_length_are_solved_together() -> None:
    views = views_of(LENS1, 10, seed=6, sigma_px=0.0)
    some = [View(view.object_points[i:], view.image_points[i:], view.name) for i, view in enumerate(views)]
    result = calibrate_intrinsics(some, LENS1.image_size)
    assert result.converged
    assert [len(errors) for errors in result.residuals] == [54 - i for i in range(10)]
    np.testing.assert_allclose(result.intrinsics.vector, LENS1.vector, rtol=1e-6, atol=1e-7)


def test_fixed_parameters_keep_the_nominals_value_and_have_no_variance() -> None:
    nominal = off_by(LENS1, 0.02)
    result = calibrate_intrinsics(
        views_of(LENS1, 10, 7), LENS1.image_size, nominal=nominal, fixed=["k3", "k1"]
    )
    assert result.fixed == ("k1", "k3")
    assert result.intrinsics.parameters["k1"] == nominal.parameters["k1"]
    assert result.sd["k1"] == result.sd["k3"] == 0.0
    assert result.sd["fx"] > 0


def test_fixed_parameters_without_a_nominal_are_zero_or_the_middle() -> None:
    result = calibrate_intrinsics(
        views_of(LENS1, 10, 8), LENS1.image_size, fixed=["p1", "p2", "k3", "cx", "cy"]
    )
    assert result.converged
    np.testing.assert_array_equal(result.intrinsics.vector[[2, 3, 6, 7, 8]], [639.5, 399.5, 0, 0, 0])


def test_residuals_are_detected_minus_projected_at_the_reported_poses() -> None:
    views = views_of(LENS1, 6, seed=9)
    result = calibrate_intrinsics(views, LENS1.image_size)
    for view, pose, errors in zip(views, result.poses, result.residuals, strict=True):
        pixels = project(result.intrinsics, pose.rotation, pose.tvec, view.object_points)
        np.testing.assert_allclose(errors, view.image_points - pixels, atol=1e-9)
    assert result.rms_px == pytest.approx(np.sqrt(np.mean([np.sum(e**2, axis=1) for e in result.residuals])))


def test_the_predicted_deviations_are_what_repeated_noise_shows() -> None:
    views = views_of(LENS1, 10, seed=10, sigma_px=0.0)
    rng = np.random.default_rng(11)
    results: list[CalibrationResult] = []
    for _ in range(60):
        noisy = [
            View(v.object_points, v.image_points + 0.1 * rng.standard_normal(v.image_points.shape))
            for v in views
        ]
        results.append(calibrate_intrinsics(noisy, LENS1.image_size, nominal=LENS1))
    observed = np.std([result.intrinsics.vector for result in results], axis=0, ddof=1)
    predicted = np.sqrt(np.mean([np.diagonal(result.covariance) for result in results], axis=0))
    np.testing.assert_allclose(observed, predicted, rtol=0.35)


@pytest.mark.parametrize("seed", range(12))
def test_a_wide_camera_is_never_silently_wrong(seed: int) -> None:
    result = calibrate_intrinsics(
        views_of(WIDE, 12, 100 + seed), WIDE.image_size, nominal=off_by(WIDE, -0.05)
    )
    assert result.converged
    assert np.abs(result.intrinsics.vector[:4] - WIDE.vector[:4]).max() < 5.0


def test_corners_that_no_lens_explains_do_not_converge_to_a_plausible_result() -> None:
    rng = np.random.default_rng(12)
    views = [View(BOARD.object_points, rng.uniform(0, 800, (54, 2))) for _ in range(6)]
    try:
        result = calibrate_intrinsics(views, LENS1.image_size)
    except DegenerateViews:
        return
    assert not result.converged or result.rms_px > 10.0


def test_parallel_boards_do_not_determine_a_camera() -> None:
    no_distortion = ["k1", "k2", "k3", "p1", "p2"]
    flat = Intrinsics.from_vector("pinhole5", np.r_[LENS1.vector[:4], np.zeros(5)], LENS1.image_size)
    views = [
        View(
            BOARD.object_points,
            project(flat, np.eye(3), np.array([0, 0, z]) - BOARD.centre, BOARD.object_points),
        )
        for z in (0.4, 0.5, 0.6, 0.7)
    ]
    with pytest.raises(DegenerateViews, match="tilted"):
        calibrate_intrinsics(views, LENS1.image_size, nominal=flat, fixed=no_distortion)


def test_two_views_are_too_few() -> None:
    with pytest.raises(TooFewViews):
        calibrate_intrinsics(views_of(LENS1, 2, seed=13), LENS1.image_size)


@pytest.mark.parametrize(
    ("nominal", "fixed", "words"),
    [
        (None, ["k9"], "k9"),
        (None, ["fx"], "nominal"),
        (WIDE, [], "1920x1208"),
    ],
)
def test_a_request_that_does_not_fit_says_why(
    nominal: Intrinsics | None, fixed: list[str], words: str
) -> None:
    with pytest.raises(IntrinsicsInvalid, match=words):
        calibrate_intrinsics(views_of(LENS1, 3, seed=14), LENS1.image_size, nominal=nominal, fixed=fixed)


def test_every_board_is_before_the_camera_and_faces_it() -> None:
    views = views_of(LENS1, 10, seed=15)
    result = calibrate_intrinsics(views, LENS1.image_size)
    for pose in result.poses:
        assert pose.rotation[2, 2] > 0
        assert pose.tvec[2] > 0
        assert np.allclose(rotation_matrix(pose.rvec), pose.rotation)
