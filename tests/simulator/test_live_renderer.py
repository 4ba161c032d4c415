"""Live frames show the board where it is, as the exact picture does, for a fraction of its cost."""

import dataclasses
from functools import lru_cache

import cv2
import numpy as np
import pytest

from service.core.vision.camera import Intrinsics
from service.core.vision.live_detection import detect_live
from service.core.vision.transforms import Array, Pose
from service.simulator.live_renderer import LiveRenderer, halve_scene
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import Scene, clean_scene, production_scene, true_corners
from tests.simulator.cameras import BOARD, FISHEYE, LENS_1, LENS_2, centred_pose, varied_poses

LENSES = {"lens 1": LENS_1, "lens 2": LENS_2, "fisheye": FISHEYE}
NOWHERE = centred_pose(BOARD, (0, 0, 0), (3.0, 0.0, 0.4))
SMALL = Intrinsics.from_parameters(
    "pinhole5", {"fx": 270.0, "fy": 270.4, "cx": 131.0, "cy": 76.4, "k1": -0.3774, "k2": 0.2425}, (256, 160)
)


@lru_cache
def _both(lens: str) -> tuple[PreparedScene, LiveRenderer]:
    scene = clean_scene(LENSES[lens], BOARD, seed=5)
    return prepare(scene), LiveRenderer(scene)


def _frame(scene: Scene, pose: Pose) -> Array:
    return LiveRenderer(scene).frame(pose, np.random.default_rng(0)).astype(np.float64)


@pytest.mark.parametrize("lens", LENSES)
def test_corners_on_live_frames_lie_within_a_twentieth_of_a_pixel_at_the_median(lens: str) -> None:
    prepared, live = _both(lens)
    errors = []
    for pose in varied_poses(LENSES[lens]):
        found = detect_live(live.frame(pose, np.random.default_rng(0)), BOARD, scale=live.scale)
        truth = true_corners(prepared.scene, pose)
        if min(np.linalg.norm(np.diff(truth.reshape(6, 9, 2), axis=i), axis=-1).min() for i in (0, 1)) < 12.0:
            continue  # smaller squares than a pose space allows
        assert found.image_points is not None
        errors.append(np.linalg.norm(found.image_points - truth, axis=1))
    assert len(errors) >= 10
    assert np.median(errors) < 0.05
    assert np.max(errors) < 0.3


@pytest.mark.parametrize("lens", LENSES)
def test_a_live_frame_is_nearly_the_halved_exact_picture(lens: str) -> None:
    prepared, live = _both(lens)
    for pose in varied_poses(LENSES[lens])[::3]:
        exact = cv2.resize(
            prepared.render(pose, np.random.default_rng(0)),
            None,
            fx=0.5,
            fy=0.5,
            interpolation=cv2.INTER_AREA,
        )
        difference = live.frame(pose, np.random.default_rng(0)).astype(np.float64) - exact
        assert np.abs(difference).mean() < 0.5
        assert np.percentile(np.abs(difference), 99.9) < 12.0


def test_a_frame_has_half_the_cameras_size_and_eight_bits() -> None:
    frame = LiveRenderer(clean_scene(SMALL, BOARD)).frame(NOWHERE, np.random.default_rng(0))
    assert frame.shape == (80, 128)
    assert frame.dtype == np.uint8


def test_the_lamp_and_the_lens_take_light_as_in_the_exact_picture() -> None:
    # Dim enough that nothing saturates: the exact picture is cut off at 255 before it is halved.
    scene = dataclasses.replace(production_scene(SMALL, BOARD), noise_grey=0.0, shading=1.0, exposure=0.6)
    pose = centred_pose(BOARD, (0, 40, 0), (0.0, 0.0, 0.4))
    exact = cv2.resize(
        prepare(scene).render(pose, np.random.default_rng(0)), (128, 80), interpolation=cv2.INTER_AREA
    )
    assert np.abs(_frame(scene, pose) - exact).mean() < 0.8


@pytest.mark.parametrize(
    "pose",
    [
        centred_pose(BOARD, (0, 0, 0), (0.0, 0.0, -0.4)),
        NOWHERE,
        centred_pose(BOARD, (0, 90, 0), (0.0, 0.0, 0.4)),
    ],
    ids=["behind", "beside", "edge-on"],
)
def test_a_board_that_the_camera_cannot_see_leaves_the_background(pose: Pose) -> None:
    scene = clean_scene(SMALL, BOARD)
    elsewhere = centred_pose(BOARD, (0, 0, 0), (0.0, 5.0, 0.4))
    np.testing.assert_array_equal(_frame(scene, pose), _frame(scene, elsewhere))


def test_a_board_partly_outside_or_partly_behind_the_camera_is_drawn_in_part() -> None:
    scene = clean_scene(SMALL, BOARD)
    background = _frame(scene, NOWHERE)
    for pose in (
        centred_pose(BOARD, (0, 0, 0), (0.15, 0.0, 0.4)),
        centred_pose(BOARD, (0, 80, 0), (0.05, 0.0, 0.08)),
    ):
        assert 0.02 < np.mean(_frame(scene, pose) != background) < 0.95


def test_the_back_of_the_plate_is_white() -> None:
    frame = _frame(clean_scene(SMALL, BOARD), centred_pose(BOARD, (0, 180, 0), (0.0, 0.0, 0.4)))
    assert np.all(frame[30:45, 50:80] == 200.0)


def test_squares_far_smaller_than_a_pixel_average_to_grey() -> None:
    frame = _frame(clean_scene(SMALL, BOARD), centred_pose(BOARD, (0, 0, 0), (0.0, 0.0, 20.0)))
    assert frame[36:41, 63:69].max() < 200.0


def test_pixels_that_the_lens_does_not_reach_show_the_background() -> None:
    folding = Intrinsics.from_parameters(
        "pinhole5", {"fx": 80.0, "fy": 80.0, "cx": 128.0, "cy": 80.0, "k1": -0.4}, (256, 160)
    )
    scene = clean_scene(folding, BOARD)
    near, background = _frame(scene, centred_pose(BOARD, (0, 0, 0), (0.0, 0.0, 0.05))), _frame(scene, NOWHERE)
    beyond = np.isnan(prepare(halve_scene(scene)).rays.directions[0])
    assert np.mean(beyond) > 0.2
    np.testing.assert_array_equal(near[beyond], background[beyond])
    assert np.mean(near[~beyond] != background[~beyond]) > 0.9


def test_the_mean_of_four_pixels_has_half_their_noise() -> None:
    scene = dataclasses.replace(clean_scene(SMALL, BOARD), clutter=0.0, noise_grey=6.0, shot_share=0.0)
    frame = LiveRenderer(scene).frame(NOWHERE, np.random.default_rng(6))
    assert np.std(frame) == pytest.approx(np.sqrt(9.0 + 1 / 12), rel=0.03)


def test_the_same_seed_gives_the_same_frame_and_another_seed_another() -> None:
    live = LiveRenderer(production_scene(SMALL, BOARD))
    pose = varied_poses(SMALL)[0]
    frame = live.frame(pose, np.random.default_rng(1))
    np.testing.assert_array_equal(frame, live.frame(pose, np.random.default_rng(1)))
    assert np.any(frame != live.frame(pose, np.random.default_rng(2)))
