from collections.abc import Callable

import numpy as np
import pytest

from service.core.errors import SceneInvalid
from service.core.vision.camera import Intrinsics, project
from service.simulator.scene import Scene, clean_scene, production_scene, true_corners
from tests.simulator.cameras import BOARD, LENS_1, LENS_2, centred_pose, varied_poses


@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("blur_px", lambda: Scene(LENS_1, BOARD, blur_px=-0.1)),
        ("noise_grey", lambda: Scene(LENS_1, BOARD, noise_grey=float("nan"))),
        ("falloff", lambda: Scene(LENS_1, BOARD, falloff=1.0)),
        ("dark_grey", lambda: Scene(LENS_1, BOARD, dark_grey=201.0)),
        ("clutter", lambda: Scene(LENS_1, BOARD, clutter=1.5)),
        ("exposure", lambda: Scene(LENS_1, BOARD, exposure=0.0)),
        ("seed", lambda: Scene(LENS_1, BOARD, seed=-1)),
    ],
)
def test_a_value_that_no_picture_can_have_is_refused_by_name(name: str, make: Callable[[], Scene]) -> None:
    with pytest.raises(SceneInvalid) as caught:
        make()
    assert caught.value.facts["name"] == name


def test_the_clean_scene_has_no_noise_and_the_production_scene_has_all() -> None:
    clean, production = clean_scene(LENS_1, BOARD), production_scene(LENS_1, BOARD)
    assert clean.blur_px == clean.noise_grey == clean.falloff == clean.shading == 0.0
    assert min(production.blur_px, production.noise_grey, production.falloff, production.shading) > 0.0


@pytest.mark.parametrize("lens", [LENS_1, LENS_2])
def test_true_corners_are_the_projection_and_lie_in_the_picture(lens: Intrinsics) -> None:
    for pose in varied_poses(lens):
        corners = true_corners(clean_scene(lens, BOARD), pose)
        expected = project(lens, pose.rotation, pose.tvec, BOARD.object_points)
        np.testing.assert_allclose(corners, expected, atol=1e-9)
        assert np.all((corners > 8) & (corners < np.array(lens.image_size) - 9))


def test_corners_behind_the_camera_are_nowhere() -> None:
    pose = centred_pose(BOARD, (0, 0, 0), (0.0, 0.0, -0.5))
    assert np.all(np.isnan(true_corners(clean_scene(LENS_1, BOARD), pose)))


def test_corners_beyond_the_fold_of_a_lens_are_nowhere_rather_than_folded_back() -> None:
    folding = Intrinsics.from_parameters(
        "pinhole5", {"fx": 500.0, "fy": 500.0, "cx": 640.0, "cy": 400.0, "k1": -0.4}, (1280, 800)
    )
    pose = centred_pose(BOARD, (0, 0, 0), (0.0, 0.0, 0.11))
    corners = true_corners(clean_scene(folding, BOARD), pose)
    radius = np.linalg.norm((BOARD.object_points - BOARD.centre)[:, :2], axis=1) / 0.11
    np.testing.assert_array_equal(np.isnan(corners[:, 0]), radius > np.sqrt(1 / 1.2))
