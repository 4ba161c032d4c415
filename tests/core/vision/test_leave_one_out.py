"""Leaving a view out by a downdate against solving again without it."""

import numpy as np

from service.core.vision.calibration import calibrate_intrinsics
from service.core.vision.leave_one_out import leave_one_out
from service.core.vision.view_stack import View
from tests.core.vision.cameras import LENS1, views_of


def test_a_downdate_is_close_to_a_solve_without_the_view() -> None:
    views = views_of(LENS1, 10, seed=1)
    result = calibrate_intrinsics(views, LENS1.image_size, nominal=LENS1)
    left_out = leave_one_out(result)
    sd = np.array(list(result.sd.values()))
    for i in range(len(views)):
        again = calibrate_intrinsics(views[:i] + views[i + 1 :], LENS1.image_size, nominal=LENS1)
        assert np.abs((left_out.vectors[i] - again.intrinsics.vector) / sd).max() < 0.15


def test_held_out_views_fit_almost_as_well_when_only_noise_is_at_work() -> None:
    views = views_of(LENS1, 12, seed=2)
    left_out = leave_one_out(calibrate_intrinsics(views, LENS1.image_size, nominal=LENS1))
    assert 1.0 <= left_out.ratio < 1.1
    assert np.all(left_out.held_out_rms_px >= left_out.fit_rms_px)


def test_the_view_of_another_camera_stands_out() -> None:
    views = views_of(LENS1, 12, seed=3)
    views[4] = View(views[4].object_points, views[4].image_points * [1.0, 1.02], "stretched")
    left_out = leave_one_out(calibrate_intrinsics(views, LENS1.image_size, nominal=LENS1))
    excess = left_out.held_out_rms_px - left_out.fit_rms_px
    assert int(np.argmax(excess)) == 4
    assert left_out.ratio > 1.3


def test_fixed_parameters_do_not_move() -> None:
    views = views_of(LENS1, 10, seed=4)
    result = calibrate_intrinsics(views, LENS1.image_size, nominal=LENS1, fixed=["k3"])
    left_out = leave_one_out(result)
    assert np.all(left_out.vectors[:, 8] == result.intrinsics.vector[8])
    assert left_out.covariance[8, 8] == 0.0


def test_the_jackknife_deviation_is_about_the_predicted_one() -> None:
    ratios = []
    for seed in range(5):
        views = views_of(LENS1, 14, seed=10 + seed)
        result = calibrate_intrinsics(views, LENS1.image_size, nominal=LENS1)
        jackknife = leave_one_out(result).covariance
        ratios.append(np.sqrt(np.diagonal(jackknife)[:4] / np.diagonal(result.covariance)[:4]))
    assert 0.7 < np.mean(ratios) < 1.6
