"""Grids of circles in live frames: each dot by its name at any roll, parts, larger grids, or nothing."""

from functools import lru_cache

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from bench.guidance_rates import empty_frame, random_boards, random_plate
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.vision.detection import detect_target
from service.core.vision.live_detection import LiveDetection, LiveWorkspace, detect_live
from service.core.vision.target_circles import Circles, parse_circles
from service.core.vision.transforms import Pose
from service.simulator.disturbances import add_glare
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene, true_corners
from service.simulator.sensor import expose
from tests.core.vision.drawn_board import to_image
from tests.simulator.cameras import LENS_1, LENS_2, centred_pose

GRID = parse_circles("circles:4x11:16mm:8mm")
LARGE = parse_circles("circles:5x7:22mm:20mm")
EVEN = parse_circles("circles:4x8:20mm:10mm")
TARGETS = pytest.mark.parametrize("target", [GRID, LARGE], ids=["dots", "large dots"])
GREY = 90
SEED = 29


@lru_cache(maxsize=8)
def scene_of(target: Circles) -> PreparedScene:
    return prepare(production_scene(LENS_1, target))


def frame(target: Circles, pose: Pose) -> NDArray[np.uint8]:
    return scene_of(target).render(pose, np.random.default_rng(5))


def pose_of(target: Circles, degrees: tuple[float, ...], centre: tuple[float, ...] = (0.0, 0.0, 0.5)) -> Pose:
    return centred_pose(target, degrees, centre)


def worst_px(seen: LiveDetection, target: Circles, pose: Pose) -> float:
    """The largest distance of a dot from the truth: a wrong name would be a step off."""
    assert seen.image_points is not None
    off = np.linalg.norm(seen.image_points - true_corners(scene_of(target).scene, pose), axis=1)
    return float(off.max())


@TARGETS
@pytest.mark.parametrize("roll", [0, 37, 90, 143, 180, 221, 270, 318])
def test_each_dot_is_the_one_that_it_is_named_at_any_roll(target: Circles, roll: int) -> None:
    pose = pose_of(target, (25.0, -18.0, roll))
    seen = detect_live(frame(target, pose), target)

    assert (seen.kind, seen.corners_seen) == ("present", len(target.object_points))
    assert worst_px(seen, target, pose) < 0.8
    assert seen.edge_width_px == pytest.approx(2.3, abs=0.7)
    assert 180 < seen.brightness < 235
    assert seen.glare_share == 0.0


@pytest.mark.parametrize("degrees", [(50, 0, 0), (-50, 0, 30), (0, 50, 0), (0, -50, 200), (34, 36, 100)])
def test_tilted_grids_are_found(degrees: tuple[int, int, int]) -> None:
    pose = pose_of(GRID, degrees)
    assert worst_px(detect_live(frame(GRID, pose), GRID), GRID, pose) < 0.8


def test_random_grids_in_motion_and_out_of_focus_are_found_as_a_capture_orders_them() -> None:
    workspace = LiveWorkspace()
    for pose, _, image in random_boards(scene_of(GRID), 10, SEED):
        assert worst_px(detect_live(image, GRID, workspace), GRID, pose) < 1.5


def test_a_frame_at_half_size_gives_the_same() -> None:
    image = frame(GRID, pose_of(GRID, (10.0, 20.0, 30.0)))
    half = np.asarray(cv2.resize(image, (640, 400), interpolation=cv2.INTER_AREA), dtype=np.uint8)
    whole, sent = detect_live(image, GRID), detect_live(half, GRID, scale=2)

    assert whole.image_points is not None
    assert sent.image_points == pytest.approx(whole.image_points, abs=0.2)


def test_a_grid_seen_from_near_is_followed_through_strong_perspective() -> None:
    """Each step across is a fifth shorter than the one before it."""
    near = parse_circles("circles:4x11:20mm:10mm")
    pose = pose_of(near, (-35.0, 42.0, 40.0), (-0.03, 0.0, 0.4))
    seen = detect_live(scene_of(near).render(pose, np.random.default_rng(5)), near)
    truth = true_corners(scene_of(near).scene, pose)
    assert truth.min() > 20.0
    assert np.all(truth.max(axis=0) < np.array([1260.0, 780.0]))

    assert worst_px(seen, near, pose) < 1.0


def test_a_symmetric_grid_points_to_the_right_as_in_a_capture() -> None:
    for roll in (0, 60, 85, 120, 180, 240, 300):
        pose = pose_of(EVEN, (10.0, 10.0, roll), (0.0, 0.0, 0.6))
        image = frame(EVEN, pose)
        seen = detect_live(image, EVEN)

        assert seen.image_points is not None
        assert seen.image_points[3, 0] > seen.image_points[0, 0]
        assert seen.image_points == pytest.approx(detect_target(image, EVEN).image_points, abs=0.8)


def test_a_part_is_told_as_a_part_and_less_than_a_third_as_nothing() -> None:
    pose = pose_of(GRID, (5.0, 10.0, 0.0))
    image = frame(GRID, pose)
    places = true_corners(scene_of(GRID).scene, pose).reshape(11, 4, 2)
    for rows, kind in ((7, "partial"), (2, "absent")):
        cut = image.copy()
        cut[int(places[rows, :, 1].mean()) - 12 :] = GREY
        seen = detect_live(cut, GRID)
        assert (seen.kind, seen.image_points) == (kind, None)
        assert 4 * rows - 2 <= seen.corners_seen <= 4 * rows + 2 or kind == "absent"


def test_a_dot_that_the_border_cuts_is_not_seen_as_no_capture_would_take_it() -> None:
    pose = pose_of(GRID, (0.0, 0.0, 0.0), (-0.207, 0.0, 0.5))
    image = frame(GRID, pose)
    left = true_corners(scene_of(GRID).scene, pose)[:, 0].min()
    assert 0.0 < left < 10.0

    assert detect_live(image, GRID).kind == "partial"


def test_a_covered_dot_makes_a_part() -> None:
    pose = pose_of(GRID, (10.0, 5.0, 20.0))
    image = frame(GRID, pose)
    x, y = true_corners(scene_of(GRID).scene, pose)[17].astype(int)
    image[y - 30 : y + 30, x - 30 : x + 30] = 200
    seen = detect_live(image, GRID)

    assert seen.kind == "partial"
    assert 38 <= seen.corners_seen <= 43


@pytest.mark.parametrize("counts", ["4x9", "3x11", "3x8"])
def test_a_larger_grid_than_declared_is_wrong(counts: str) -> None:
    for roll in (-25.0, 160.0):
        image = frame(GRID, pose_of(GRID, (10.0, 15.0, roll)))
        seen = detect_live(image, parse_circles(f"circles:{counts}:16mm:8mm"))
        assert (seen.kind, seen.image_points) == ("wrong", None)


def test_noise_and_plain_frames_hold_no_grid() -> None:
    rng = np.random.default_rng(1)
    frames = [np.full((800, 1280), level, dtype=np.uint8) for level in (0, 127, 255)]
    for sigma in (0.0, 1.0, 2.5, 5.0):
        noise = rng.standard_normal((800, 1280))
        soft = cv2.GaussianBlur(noise, (0, 0), sigma) * (1.0 + 2.0 * sigma) if sigma else noise
        frames.append(np.clip(127 + 80 * soft, 0, 255).astype(np.uint8))

    assert {detect_live(image, GRID).kind for image in frames} == {"absent"}


def test_nothing_is_seen_in_empty_frames_and_perforated_plates() -> None:
    rng, workspace = np.random.default_rng(SEED), LiveWorkspace()
    for number in range(8):
        assert detect_live(empty_frame(scene_of(GRID), number, SEED, rng), GRID, workspace).kind == "absent"
    for _ in range(16):
        plate = to_image(random_plate((640, 400), rng) + rng.normal(0.0, 2.0, (400, 640)))
        assert detect_live(plate, GRID, workspace, scale=2).kind == "absent"


def test_a_lamp_from_the_side_and_pictures_of_a_camera_that_packs_them() -> None:
    pose = pose_of(GRID, (20.0, 15.0, 10.0))
    light = scene_of(GRID).light(pose)
    fading = light * np.linspace(0.25, 1.2, light.shape[1])
    noisy = np.clip(fading + np.random.default_rng(2).normal(0.0, 3.0, light.shape), 0, 255).astype(np.uint8)
    packed = cv2.imdecode(cv2.imencode(".jpg", noisy, [cv2.IMWRITE_JPEG_QUALITY, 60])[1], 0)

    for image in (noisy, packed):
        assert worst_px(detect_live(np.asarray(image, dtype=np.uint8), GRID), GRID, pose) < 1.0


def test_glare_is_told_and_what_it_hides_makes_a_part() -> None:
    pose = pose_of(GRID, (5.0, 5.0, 0.0))
    prepared = scene_of(GRID)
    x, y = true_corners(prepared.scene, pose)[[20, 24]].mean(axis=0)
    mild, strong = (
        detect_live(
            expose(
                add_glare(prepared.light(pose), (float(x), float(y)), 70.0, level),
                prepared.scene,
                np.random.default_rng(3),
            ),
            GRID,
        )
        for level in (90.0, 2000.0)
    )
    assert mild.kind == "present"
    assert mild.glare_share is not None
    assert mild.glare_share > 0.1
    assert strong.kind == "partial"


def test_a_dot_s_rim_keeps_clear_of_the_border_in_every_planned_pose() -> None:
    near = PoseSpace(distance_m=(0.25, 0.4), image_margin_px=2.0, separation_px=10.0)
    for camera in (LENS_1, LENS_2):
        poses = sample_poses(near, camera, LARGE, 40, 3)
        scene = production_scene(camera, LARGE)
        for i in range(len(poses)):
            for angle in np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False):
                away = 0.5 * LARGE.diameter_m * np.array([np.cos(angle), np.sin(angle), 0.0])
                moved = Pose(poses.pose(i).rvec, poses.pose(i).tvec + poses.pose(i).rotation @ away)
                places = true_corners(scene, moved)
                assert places.min() > 0.0
                assert np.all(places < np.array(camera.image_size) - 1.0)
