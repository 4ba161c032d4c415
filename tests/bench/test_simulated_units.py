"""The simulated units of the benches: reproducible, physically possible, and with the noise they claim."""

import numpy as np

from bench.simulated_units import HFOV80, HFOV120, SIGMA_PX, draw_units
from service.core.vision.calibration import calibrate_intrinsics
from service.core.vision.camera import unproject
from service.core.vision.uncertainty import whole_image


def test_a_unit_does_not_depend_on_how_many_are_drawn() -> None:
    few, many = list(draw_units(HFOV80, 1, (5, 6), seed=3)), list(draw_units(HFOV80, 3, (5, 6), seed=3))
    np.testing.assert_array_equal(few[0].true.vector, many[0].true.vector)
    np.testing.assert_array_equal(few[0].views[0].image_points, many[0].views[0].image_points)


def test_every_unit_reaches_its_image_corners_and_has_its_views() -> None:
    for unit in draw_units(HFOV120, 5, (12, 15), seed=4):
        assert np.all(np.isfinite(unproject(unit.true, whole_image(unit.true.image_size).grid(2, 2))))
        assert 12 <= len(unit.views) <= 15


def test_a_nominal_is_five_per_cent_off() -> None:
    for unit in draw_units(HFOV120, 3, (12, 12), seed=5):
        off = unit.nominal.vector / HFOV120.intrinsics.vector - 1.0
        np.testing.assert_allclose(np.abs(off[[0, 1, 4, 5, 8]]), 0.05, atol=1e-12)


def test_a_unit_is_solved_at_the_noise_it_was_drawn_with() -> None:
    unit = next(draw_units(HFOV120, 1, (15, 15), seed=6))
    result = calibrate_intrinsics(unit.views, unit.true.image_size, nominal=unit.nominal)
    assert result.converged
    assert abs(result.sigma_px / SIGMA_PX - 1.0) < 0.1
