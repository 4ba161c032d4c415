"""The mapping metric against its definition and against Monte-Carlo."""

import numpy as np
import pytest

from service.core.vision.calibration import calibrate_intrinsics
from service.core.vision.camera import Intrinsics, project_camera_points, unproject
from service.core.vision.transforms import rotation_matrix
from service.core.vision.uncertainty import (
    Region,
    difference_of_rays,
    mapping_difference,
    mapping_error,
    parameter_metric,
    whole_image,
)
from service.core.vision.view_stack import View
from tests.core.vision.cameras import LENS1, WIDE, views_of

MIDDLE = Region(200.0, 120.0, 1080.0, 680.0)


def changed(camera: Intrinsics, delta: np.ndarray) -> Intrinsics:
    return Intrinsics.from_vector(camera.lens, camera.vector + delta, camera.image_size)


def test_a_region_is_covered_from_edge_to_edge_row_by_row() -> None:
    grid = Region(10.0, 20.0, 30.0, 60.0).grid(3, 2)
    np.testing.assert_array_equal(grid, [[10, 20], [20, 20], [30, 20], [10, 60], [20, 60], [30, 60]])
    np.testing.assert_array_equal(whole_image((1280, 800)).grid(2, 2)[-1], [1279, 799])


def test_a_camera_differs_from_itself_by_nothing() -> None:
    assert mapping_difference(WIDE, WIDE, whole_image(WIDE.image_size)).max() < 1e-9


def test_rays_and_their_pixels_differ_alike() -> None:
    other = changed(LENS1, np.array([3.0, 2.0, 5.0, -4.0, 0.01, -0.02, 1e-3, -1e-3, 0.01]))
    grid = MIDDLE.grid(12, 8)
    rays = 0.7 * unproject(LENS1, grid)
    found = difference_of_rays(LENS1, other, np.vstack([rays, [0.0, 0.1, -1.0]]))
    np.testing.assert_allclose(found[:-1], mapping_difference(LENS1, other, grid), atol=1e-6)
    assert np.isnan(found[-1])


def test_a_shifted_centre_is_mostly_a_rotation() -> None:
    shifted = changed(LENS1, np.r_[0, 0, 10.0, np.zeros(6)])
    difference = mapping_difference(LENS1, shifted, MIDDLE)
    assert difference.max() < 4.0
    assert difference.max() > 0.05


def test_the_rotation_that_is_taken_out_is_the_best_one() -> None:
    other = changed(LENS1, np.array([3.0, 2.0, 5.0, -4.0, 0.01, -0.02, 1e-3, -1e-3, 0.01]))
    grid = MIDDLE.grid(12, 8)
    best = float(np.mean(mapping_difference(LENS1, other, grid) ** 2))
    rays = unproject(LENS1, grid)
    rng = np.random.default_rng(4)
    around = np.array([-4.0 / 1350, -5.0 / 1350, 0.0])
    for rvec in around + 2e-3 * rng.standard_normal((200, 3)):
        moved = project_camera_points(other, rays @ rotation_matrix(rvec).T)
        assert np.mean(np.sum((grid - moved) ** 2, axis=-1)) >= best - 1e-9


@pytest.mark.parametrize("camera", [LENS1, WIDE])
def test_the_metric_is_the_mean_squared_difference_of_small_changes(camera: Intrinsics) -> None:
    region = Region(200.0, 120.0, camera.image_size[0] - 200.0, camera.image_size[1] - 120.0)
    H = parameter_metric(camera, region)
    rng = np.random.default_rng(5)
    for _ in range(5):
        delta = 1e-2 * rng.standard_normal(9) * np.array([1, 1, 1, 1, 1e-3, 1e-3, 1e-4, 1e-4, 1e-3])
        squared = np.mean(mapping_difference(camera, changed(camera, delta), region) ** 2)
        assert squared == pytest.approx(delta @ H @ delta, rel=0.02)


def test_the_mean_mapping_error_is_the_root_of_the_trace_with_the_metric() -> None:
    A = np.random.default_rng(6).standard_normal((9, 9)) * np.array(
        [1, 1, 1, 1, 1e-3, 1e-3, 1e-4, 1e-4, 1e-3]
    )
    covariance = A.T @ A
    error = mapping_error(LENS1, covariance, MIDDLE)
    assert error.mean_px == pytest.approx(np.sqrt(np.trace(parameter_metric(LENS1, MIDDLE) @ covariance)))
    assert error.worst_px >= error.mean_px


def test_nothing_is_promised_where_the_lens_does_not_reach() -> None:
    folding = Intrinsics.from_parameters(
        "pinhole5", {"fx": 600, "fy": 600, "cx": 640, "cy": 400, "k1": -0.3}, (1280, 800)
    )
    error = mapping_error(folding, np.eye(9), whole_image((1280, 800)))
    assert error.mean_px == error.worst_px == float("inf")
    assert np.isnan(mapping_difference(folding, folding, whole_image((1280, 800)))[0])


def test_the_predicted_mapping_error_is_what_repeated_calibrations_show() -> None:
    views = views_of(LENS1, 10, seed=7, sigma_px=0.0)
    rng = np.random.default_rng(8)
    squared = []
    predicted = 0.0
    for _ in range(40):
        noisy = [
            View(v.object_points, v.image_points + 0.1 * rng.standard_normal(v.image_points.shape))
            for v in views
        ]
        result = calibrate_intrinsics(noisy, LENS1.image_size, nominal=LENS1)
        squared.append(np.mean(mapping_difference(LENS1, result.intrinsics, MIDDLE) ** 2))
        predicted += mapping_error(result.intrinsics, result.covariance, MIDDLE).mean_px ** 2 / 40
    assert np.sqrt(np.mean(squared)) == pytest.approx(np.sqrt(predicted), rel=0.25)
