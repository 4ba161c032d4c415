"""The figures of residuals on numbers that can be worked out by hand."""

import numpy as np
import pytest

from service.core.vision.residuals import (
    mean_reprojection_error,
    outlier_share,
    rms,
    summarise_residuals,
    view_rms,
    worst_to_median_view,
)

STILL = np.zeros((4, 2))
THREE_FOUR = np.tile([3.0, 4.0], (4, 1))
ONE = np.tile([1.0, 0.0], (2, 1))


def test_rms_and_mean_are_over_corners_and_not_over_views() -> None:
    assert rms([STILL, THREE_FOUR, ONE]) == pytest.approx(np.sqrt((4 * 25 + 2 * 1) / 10))
    assert mean_reprojection_error([STILL, THREE_FOUR, ONE]) == pytest.approx((4 * 5 + 2 * 1) / 10)


def test_each_view_has_its_own_rms() -> None:
    np.testing.assert_allclose(view_rms([STILL, THREE_FOUR, ONE]), [0.0, 5.0, 1.0])
    assert worst_to_median_view([STILL, THREE_FOUR, ONE]) == pytest.approx(5.0)


def test_views_without_error_are_all_alike() -> None:
    assert worst_to_median_view([STILL, STILL, STILL]) == 1.0


def test_an_outlier_is_a_corner_with_a_coordinate_beyond_four_sigma() -> None:
    errors = np.zeros((10, 2))
    errors[0] = 0.0, -4.1
    errors[1] = 3.9, 3.9
    assert outlier_share([errors], sigma_px=1.0) == pytest.approx(0.1)
    assert outlier_share([0.007 * errors], sigma_px=0.007) == 0.0  # 0.029 px


def test_the_summary_names_the_worst_view() -> None:
    summary = summarise_residuals([ONE, THREE_FOUR, ONE], sigma_px=1.0)
    assert (summary.worst_view, summary.worst_view_rms_px, summary.max_error_px) == (1, 5.0, 5.0)
    assert summary.worst_to_median_view == pytest.approx(5.0)
