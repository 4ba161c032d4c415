"""The solve with the wide lens models: against known truth, against OpenCV, and its predictions."""

import cv2
import numpy as np
import pytest

from bench.simulated_units import RATIONAL120, SIGMA_PX, draw_units
from service.core.vision.calibration import calibrate_intrinsics
from service.core.vision.camera import Intrinsics
from service.core.vision.leave_one_out import leave_one_out
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region, mapping_difference, mapping_error, whole_image
from service.core.vision.view_stack import View
from tests.core.vision.cameras import ALL_ROUND, BOARD, FISHEYE, RATIONAL, views_of

TIGHT = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 1000, 1e-15)
WIDE_LENSES = pytest.mark.parametrize(
    "camera", [RATIONAL, FISHEYE, ALL_ROUND], ids=["rational", "fisheye", "200 degrees"]
)


def off_by(camera: Intrinsics, share: float) -> Intrinsics:
    vector = camera.vector * np.r_[1 + share, 1 + share, 1, 1, np.full(len(camera.dist_coeffs), 1 - share)]
    return Intrinsics.from_vector(camera.lens, vector, camera.image_size)


def in_single_precision(views: list[View]) -> list[View]:
    return [View(v.object_points, v.image_points.astype(np.float32).astype(np.float64)) for v in views]


def seen_pixels(views: list[View]) -> Array:
    return np.concatenate([view.image_points for view in views])


def solve_with_opencv(views: list[View], camera: Intrinsics) -> tuple[float, Intrinsics]:
    """Return OpenCV's rms and optimum for the camera's lens model, from its own start."""
    count = len(camera.dist_coeffs)
    nothing = np.zeros((3, 3)), np.zeros((count, 1))
    if camera.lens == "rational8":
        found = cv2.calibrateCamera(
            [view.object_points.astype(np.float32) for view in views],
            [view.image_points.astype(np.float32) for view in views],
            camera.image_size,
            *nothing,
            flags=cv2.CALIB_RATIONAL_MODEL,
            criteria=TIGHT,
        )
    else:
        found = cv2.fisheye.calibrate(
            [view.object_points[None] for view in views],
            [view.image_points[None] for view in views],
            camera.image_size,
            *nothing,
            flags=cv2.CALIB_RECOMPUTE_EXTRINSIC + cv2.CALIB_FIX_SKEW,
            criteria=TIGHT,
        )
    K, k = (np.asarray(part, dtype=np.float64) for part in found[1:3])
    return float(found[0]), Intrinsics(camera.lens, K, k.ravel()[:count], camera.image_size)


@WIDE_LENSES
@pytest.mark.parametrize("with_nominal", [True, False])
def test_exact_corners_give_the_exact_camera(camera: Intrinsics, with_nominal: bool) -> None:
    nominal = off_by(camera, 0.03) if with_nominal else None
    views = views_of(camera, 10, 1, sigma_px=0.0)
    result = calibrate_intrinsics(views, camera.image_size, camera.lens, nominal=nominal)
    assert result.converged
    assert result.rms_px < 1e-6
    assert np.abs(result.intrinsics.vector[:4] - camera.vector[:4]).max() < 1e-4
    assert mapping_difference(camera, result.intrinsics, seen_pixels(views)).max() < 1e-5


@WIDE_LENSES
@pytest.mark.parametrize("seed", [0, 2, 4])
def test_the_optimum_is_opencvs(camera: Intrinsics, seed: int) -> None:
    views = in_single_precision(views_of(camera, 20, seed))
    result = calibrate_intrinsics(views, camera.image_size, camera.lens)
    rms, optimum = solve_with_opencv(views, camera)
    assert result.converged
    assert result.rms_px == pytest.approx(rms, abs=1e-6)
    np.testing.assert_allclose(result.intrinsics.vector[:4], optimum.vector[:4], atol=1e-3)
    assert mapping_difference(result.intrinsics, optimum, seen_pixels(views)).max() < 1e-3


def test_a_solve_succeeds_where_opencvs_fisheye_start_gives_up() -> None:
    views = in_single_precision(views_of(ALL_ROUND, 20, 1))
    with pytest.raises(cv2.error):
        solve_with_opencv(views, ALL_ROUND)
    result = calibrate_intrinsics(views, ALL_ROUND.image_size, ALL_ROUND.lens)
    assert result.converged
    assert mapping_difference(ALL_ROUND, result.intrinsics, seen_pixels(views)).max() < 0.5


@pytest.mark.parametrize("camera", [FISHEYE, ALL_ROUND], ids=["fisheye", "200 degrees"])
def test_a_nominal_far_off_ends_at_the_same_camera(camera: Intrinsics) -> None:
    views = views_of(camera, 12, seed=4)
    near = calibrate_intrinsics(views, camera.image_size, camera.lens, nominal=camera)
    far = calibrate_intrinsics(views, camera.image_size, camera.lens, nominal=off_by(camera, 0.3))
    assert near.converged
    assert far.converged
    assert mapping_difference(near.intrinsics, far.intrinsics, whole_image(camera.image_size)).max() < 1e-2


@WIDE_LENSES
def test_leave_one_out_finds_the_view_that_does_not_belong(camera: Intrinsics) -> None:
    views = views_of(camera, 14, seed=3)
    turned = views[5].image_points + np.linspace(-1.0, 1.0, len(BOARD.object_points))[:, None]
    views[5] = View(BOARD.object_points, turned, "odd")
    fixed = ["k6"] if camera.lens == "rational8" else []
    result = calibrate_intrinsics(views, camera.image_size, camera.lens, fixed=fixed)
    without = leave_one_out(result)
    assert int(np.argmax(without.held_out_rms_px)) == 5
    assert without.ratio > 1.0


@pytest.mark.parametrize(
    ("camera", "fixed"), [(FISHEYE, ()), (RATIONAL, ("k6",))], ids=["fisheye", "rational"]
)
def test_the_predicted_deviations_are_what_repeated_noise_shows(
    camera: Intrinsics, fixed: tuple[str, ...]
) -> None:
    """The pinhole parameters with all their correlations, and the mapping: 10 % of an sd, each."""
    exact = views_of(camera, 16, seed=12, sigma_px=0.0)
    rng = np.random.default_rng(5)
    region = Region(*seen_pixels(exact).min(axis=0), *seen_pixels(exact).max(axis=0))
    grid = region.grid(9, 6)
    errors, covariances, squares = [], [], []
    for _ in range(150):
        noisy = [
            View(v.object_points, v.image_points + 0.1 * rng.standard_normal(v.image_points.shape))
            for v in exact
        ]
        result = calibrate_intrinsics(noisy, camera.image_size, camera.lens, nominal=camera, fixed=fixed)
        assert result.converged
        errors.append(result.intrinsics.vector[:4] - camera.vector[:4])
        covariances.append(result.covariance)
        squares.append(np.mean(mapping_difference(camera, result.intrinsics, grid) ** 2))
    covariance = np.mean(covariances, axis=0)
    squared = np.einsum("ni,ij,nj->n", errors, np.linalg.inv(covariance[:4, :4]), errors)
    assert np.sqrt(np.mean(squared) / 4.0) == pytest.approx(1.0, abs=0.1)
    expected_px = mapping_error(camera, covariance, grid).mean_px
    assert np.sqrt(np.mean(squares)) == pytest.approx(expected_px, rel=0.1)


@pytest.mark.parametrize("lens", ["rational8", "kannala_brandt4"])
def test_what_boards_in_the_middle_cannot_tell_of_the_corners_is_not_claimed(lens: str) -> None:
    views = [
        View(view.object_points[:20], view.image_points[:20])
        for view in views_of(RATIONAL, 60, seed=8)
        if np.all(np.abs(view.image_points - RATIONAL.vector[2:4]) < 420.0)
    ]
    result = calibrate_intrinsics(views, RATIONAL.image_size, lens)
    whole = mapping_error(result.intrinsics, result.covariance, whole_image(RATIONAL.image_size))
    assert mapping_error(result.intrinsics, result.covariance, seen_pixels(views)).mean_px < 2.0
    assert whole.worst_px > 20.0


@pytest.mark.parametrize("number", [6, 58])
def test_a_few_corners_that_lead_beyond_the_fold_do_not_end_the_solve(number: int) -> None:
    *_, unit = draw_units(RATIONAL120, number + 1, (4, 10), 99)
    result = calibrate_intrinsics(
        unit.views, unit.true.image_size, unit.true.lens, nominal=unit.nominal, fixed=RATIONAL120.fixed
    )
    assert result.sigma_px == pytest.approx(SIGMA_PX, rel=0.15)
