"""Boards with markers in live frames: named right at any roll, in parts too, and never without a board."""

from functools import lru_cache

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from service.core.vision.live_detection import LiveDetection, LiveWorkspace, detect_live
from service.core.vision.target import parse_target
from service.core.vision.transforms import Pose
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene, true_corners
from tests.simulator.cameras import LENS_1, centred_pose

CHARUCO = "charuco:8x5:25mm:18mm:4x4_250"
APRILGRID = "aprilgrid:5x4:32mm:0.3"
CHESSBOARD = "chessboard:8x5:25mm"
CODED = pytest.mark.parametrize("spec", [CHARUCO, APRILGRID])
GREY = 90


@lru_cache(maxsize=8)
def scene_of(spec: str) -> PreparedScene:
    return prepare(production_scene(LENS_1, parse_target(spec)))


def frame(spec: str, pose: Pose) -> NDArray[np.uint8]:
    return scene_of(spec).render(pose, np.random.default_rng(5))


def pose_of(spec: str, degrees: tuple[float, ...], centre: tuple[float, ...] = (0.0, 0.0, 0.5)) -> Pose:
    return centred_pose(parse_target(spec), degrees, centre)


def worst_px(seen: LiveDetection, spec: str, pose: Pose) -> float:
    """The largest distance of a corner from the truth: a wrong name would be a square off."""
    assert seen.kind == "present"
    assert seen.image_points is not None
    assert int((~np.isnan(seen.image_points[:, 0])).sum()) == seen.corners_seen
    off = np.linalg.norm(seen.image_points - true_corners(scene_of(spec).scene, pose), axis=1)
    return float(np.nanmax(off))


@CODED
@pytest.mark.parametrize("roll", [0, 37, 90, 143, 180, 221, 270, 318])
def test_corners_are_named_and_within_half_a_pixel_at_any_roll(spec: str, roll: int) -> None:
    pose = pose_of(spec, (25.0, -18.0, roll))
    seen = detect_live(frame(spec, pose), parse_target(spec))

    assert worst_px(seen, spec, pose) < 0.5
    assert seen.corners_seen > 0.8 * len(parse_target(spec).object_points)
    assert seen.edge_width_px == pytest.approx(2.3, abs=0.6)
    assert 150 < seen.brightness < 230
    assert seen.glare_share == pytest.approx(0.0, abs=0.15)


@CODED
def test_a_frame_at_half_size_gives_the_same(spec: str) -> None:
    pose, workspace = pose_of(spec, (10.0, 20.0, 30.0)), LiveWorkspace()
    image = frame(spec, pose)
    half = cv2.resize(image, (640, 400), interpolation=cv2.INTER_AREA)
    whole = detect_live(image, parse_target(spec), workspace)
    sent = detect_live(np.asarray(half, dtype=np.uint8), parse_target(spec), workspace, scale=2)

    assert whole.image_points is not None
    assert sent.image_points == pytest.approx(whole.image_points, abs=0.1, nan_ok=True)


@CODED
def test_a_part_that_a_capture_would_take_is_present(spec: str) -> None:
    half_out = pose_of(spec, (10.0, 5.0, 20.0), (0.16, -0.08, 0.4))
    seen = detect_live(frame(spec, half_out), parse_target(spec))

    assert worst_px(seen, spec, half_out) < 0.7
    assert 12 <= seen.corners_seen < len(parse_target(spec).object_points)


@pytest.mark.parametrize(("height", "kind", "corners"), [(300, "present", 12), (200, "partial", 9)])
def test_a_piece_with_fewer_than_twelve_corners_is_partial(height: int, kind: str, corners: int) -> None:
    image = frame(CHARUCO, pose_of(CHARUCO, (0.0, 0.0, 0.0)))
    piece = np.full_like(image, GREY)
    rows, columns = slice(400 - height // 2, 400 + height // 2), slice(550, 730)
    piece[rows, columns] = image[rows, columns]
    seen = detect_live(piece, parse_target(CHARUCO))

    assert (seen.kind, seen.corners_seen) == (kind, corners)
    assert (seen.image_points is None) == (kind == "partial")


@CODED
def test_parts_that_an_arm_separates_are_one_board(spec: str) -> None:
    pose = pose_of(spec, (5.0, 10.0, 0.0))
    image = frame(spec, pose)
    middle = true_corners(scene_of(spec).scene, pose).mean(axis=0)
    whole = detect_live(image, parse_target(spec)).corners_seen
    x = int(middle[0])
    image[:, x - 75 : x + 75] = GREY
    seen = detect_live(image, parse_target(spec))

    assert worst_px(seen, spec, pose) < 1.5
    assert 0.5 * whole < seen.corners_seen < whole
    assert seen.image_points is not None
    columns = seen.image_points[~np.isnan(seen.image_points[:, 0]), 0]
    assert columns.min() < x - 90
    assert columns.max() > x + 90


@pytest.mark.parametrize(
    ("shown", "declared"),
    [
        (CHESSBOARD, CHARUCO),
        ("charuco:8x5:25mm:18mm:5x5_250", CHARUCO),
        (CHESSBOARD, APRILGRID),
    ],
)
def test_another_board_is_wrong_and_never_the_declared_one(shown: str, declared: str) -> None:
    seen = detect_live(frame(shown, pose_of(shown, (12.0, -8.0, 20.0))), parse_target(declared))

    assert (seen.kind, seen.image_points) == ("wrong", None)


@pytest.mark.parametrize(("shown", "declared"), [(CHARUCO, APRILGRID), (APRILGRID, CHARUCO)])
def test_markers_in_another_place_are_not_the_declared_board(shown: str, declared: str) -> None:
    seen = detect_live(frame(shown, pose_of(shown, (12.0, -8.0, 20.0))), parse_target(declared))

    assert (seen.kind, seen.image_points) == ("absent", None)


@CODED
def test_a_mirrored_board_is_never_present(spec: str) -> None:
    image = np.ascontiguousarray(frame(spec, pose_of(spec, (15.0, -10.0, 30.0)))[:, ::-1])

    assert detect_live(image, parse_target(spec)).kind != "present"


@CODED
def test_noise_and_plain_frames_hold_no_board(spec: str) -> None:
    rng = np.random.default_rng(1)
    frames = [np.full((800, 1280), 127, dtype=np.uint8)]
    for sigma in (0.0, 1.0, 2.5, 5.0):
        noise = rng.standard_normal((800, 1280))
        soft = cv2.GaussianBlur(noise, (0, 0), sigma) * (1.0 + 2.0 * sigma) if sigma else noise
        frames.append(np.clip(127 + 80 * soft, 0, 255).astype(np.uint8))

    assert {detect_live(image, parse_target(spec)).kind for image in frames} == {"absent"}
