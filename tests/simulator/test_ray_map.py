import numpy as np
import pytest

from service.core.vision.camera import Intrinsics, project_camera_points, unproject
from service.simulator.ray_map import trace_rays
from tests.simulator.cameras import ALL_ROUND, FISHEYE, LENS_1, LENS_2


@pytest.mark.parametrize("lens", [LENS_1, LENS_2, FISHEYE, ALL_ROUND])
def test_every_ray_leads_back_to_its_pixel(lens: Intrinsics) -> None:
    directions = np.moveaxis(trace_rays(lens).directions[:, ::9, ::9], 0, -1)
    back = project_camera_points(lens, directions)
    rows, columns = np.mgrid[: lens.image_size[1] : 9, : lens.image_size[0] : 9]
    np.testing.assert_allclose(back, np.stack([columns, rows], axis=-1), atol=1e-8)


def test_the_corners_of_an_all_round_lens_look_behind_the_camera() -> None:
    assert trace_rays(ALL_ROUND).directions[2, 0, 0] < -0.1


def test_where_a_lens_folds_the_map_has_no_ray_just_as_unproject_has_none() -> None:
    folding = Intrinsics.from_parameters(
        "pinhole5", {"fx": 80.0, "fy": 80.0, "cx": 100.0, "cy": 60.0, "k1": -0.4}, (200, 120)
    )
    directions = np.moveaxis(trace_rays(folding).directions, 0, -1)
    rows, columns = np.mgrid[:120, :200]
    expected = unproject(folding, np.stack([columns, rows], axis=-1))
    assert 0.05 < np.mean(np.isnan(expected)) < 0.95
    across = directions[..., :2] / directions[..., 2:]
    np.testing.assert_allclose(across, expected[..., :2], atol=1e-9)


@pytest.mark.parametrize("lens", [LENS_1, FISHEYE])
def test_the_jacobian_is_the_slope_of_the_map_across_the_ray(lens: Intrinsics) -> None:
    rays = trace_rays(lens)
    unit = rays.directions / np.linalg.norm(rays.directions, axis=0)
    right = 0.5 * (unit[:, 700, 1202] - unit[:, 700, 1200])
    down = 0.5 * (unit[:, 701, 1201] - unit[:, 699, 1201])
    direction = rays.directions[:, 700, 1201]
    jacobian = rays.jacobian(direction[None])[0] / np.linalg.norm(direction)
    np.testing.assert_allclose(jacobian, np.stack([right, down], axis=1), rtol=1e-5, atol=1e-9)
    half_diagonal = np.linalg.norm(jacobian @ np.array([0.5, 0.5])) * np.linalg.norm(direction)
    assert half_diagonal <= rays.spread[700, 1201]
