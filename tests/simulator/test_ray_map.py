import numpy as np
import pytest

from service.core.vision.camera import Intrinsics, project_camera_points, undistort
from service.simulator.ray_map import trace_rays
from tests.simulator.cameras import LENS_1, LENS_2


@pytest.mark.parametrize("lens", [LENS_1, LENS_2])
def test_every_ray_of_the_papers_lenses_leads_back_to_its_pixel(lens: Intrinsics) -> None:
    ideal = np.moveaxis(trace_rays(lens).ideal[:, ::9, ::9], 0, -1)
    back = project_camera_points(lens, np.concatenate([ideal, np.ones((*ideal.shape[:2], 1))], axis=-1))
    rows, columns = np.mgrid[: lens.image_size[1] : 9, : lens.image_size[0] : 9]
    np.testing.assert_allclose(back, np.stack([columns, rows], axis=-1), atol=1e-8)


def test_where_a_lens_folds_the_map_has_no_ray_just_as_undistort_has_none() -> None:
    folding = Intrinsics.from_parameters(
        "pinhole5", {"fx": 80.0, "fy": 80.0, "cx": 100.0, "cy": 60.0, "k1": -0.4}, (200, 120)
    )
    ideal = np.moveaxis(trace_rays(folding).ideal, 0, -1)
    rows, columns = np.mgrid[:120, :200]
    expected = undistort(folding, np.stack([columns, rows], axis=-1))
    assert 0.05 < np.mean(np.isnan(expected)) < 0.95
    np.testing.assert_allclose(ideal, expected, atol=1e-9)


def test_the_jacobian_is_the_slope_of_the_map() -> None:
    rays = trace_rays(LENS_1)
    right = 0.5 * (rays.ideal[:, 700, 1202] - rays.ideal[:, 700, 1200])
    down = 0.5 * (rays.ideal[:, 701, 1201] - rays.ideal[:, 699, 1201])
    jacobian = rays.jacobian(rays.ideal[:, 700, 1201][None])[0]
    np.testing.assert_allclose(jacobian, np.stack([right, down], axis=1), rtol=1e-5, atol=1e-9)
