import numpy as np

from service.core.vision.tolerance import Tolerance, draw_camera
from tests.core.vision.cameras import LENS1 as LENS_1


def test_cameras_of_a_sku_differ_within_its_tolerance_and_a_seed_repeats_them() -> None:
    tolerance = Tolerance(focal_share=0.01, aspect_share=0.001, centre_px=5.0, coefficients={"k1": 0.02})
    rng = np.random.default_rng(1)
    drawn = np.array([draw_camera(LENS_1, tolerance, rng).vector for _ in range(200)])
    off = np.abs(drawn - LENS_1.vector)
    assert np.all(off[:, :2] <= 0.0105 * LENS_1.vector[:2])
    assert np.all(off[:, 2:4] <= 5.0)
    assert np.all(off[:, 4] <= 0.02)
    assert np.all(off[:, 5:] == 0.0)
    assert np.all(off[:, :5].max(axis=0) > 0.9 * np.array([13.5, 13.5, 5.0, 5.0, 0.02]))
    again = draw_camera(LENS_1, tolerance, np.random.default_rng(1)).vector
    np.testing.assert_array_equal(again, drawn[0])
