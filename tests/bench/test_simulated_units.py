"""The simulated units of the benches: reproducible, physically possible, and with the noise they claim."""

import numpy as np
import pytest

from bench.simulated_units import FISHEYE120, HFOV80, HFOV120, RATIONAL120, SIGMA_PX, Design, draw_units
from service.core.vision.calibration import calibrate_intrinsics
from service.core.vision.camera import reach_share, unproject
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


@pytest.mark.parametrize("design", [RATIONAL120, FISHEYE120], ids=lambda design: design.name)
def test_wide_units_have_their_lens_and_reach_their_image_corners(design: Design) -> None:
    for unit in draw_units(design, 2, (12, 12), seed=4):
        corners = unproject(unit.true, whole_image(unit.true.image_size).grid(2, 2))
        assert unit.true.lens == unit.nominal.lens == design.name
        assert np.all(reach_share(unit.true, corners) < 0.95)
        assert len(unit.views) == 12


def test_a_unit_is_solved_at_the_noise_it_was_drawn_with() -> None:
    unit = next(draw_units(HFOV120, 1, (15, 15), seed=6))
    result = calibrate_intrinsics(unit.views, unit.true.image_size, nominal=unit.nominal)
    assert result.converged
    assert abs(result.sigma_px / SIGMA_PX - 1.0) < 0.1
