"""Boards with markers in rendered pictures: corners against the truth, parts of boards, refusals by name."""

from functools import lru_cache

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible, WrongTarget
from service.core.vision.detection import Detection, detect_target
from service.core.vision.target import parse_target
from service.core.vision.transforms import Array, Pose
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import clean_scene, production_scene, true_corners
from tests.simulator.cameras import LENS_1, centred_pose

CHARUCO = "charuco:8x5:25mm:18mm:4x4_250"
APRILGRID = "aprilgrid:5x4:32mm:0.3"
CODED = pytest.mark.parametrize("spec", [CHARUCO, APRILGRID])
SIZE = np.array(LENS_1.image_size)


@lru_cache(maxsize=8)
def scene_of(spec: str, *, clean: bool = True) -> PreparedScene:
    make = clean_scene if clean else production_scene
    return prepare(make(LENS_1, parse_target(spec)))


def picture(spec: str, pose: Pose, *, clean: bool = True) -> NDArray[np.uint8]:
    return scene_of(spec, clean=clean).render(pose, np.random.default_rng(5))


def pose_of(spec: str, degrees: tuple[float, ...], centre: tuple[float, ...] = (0.0, 0.0, 0.5)) -> Pose:
    return centred_pose(parse_target(spec), degrees, centre)


def errors(detection: Detection, spec: str, pose: Pose) -> Array:
    return np.asarray(detection.image_points - true_corners(scene_of(spec).scene, pose)[detection.corner_ids])


@CODED
@pytest.mark.parametrize("roll", [0, 37, 90, 143, 180, 221, 270, 318])
def test_at_any_roll_each_corner_is_the_one_that_it_is_named(spec: str, roll: int) -> None:
    pose = pose_of(spec, (12.0, -8.0, roll))
    found = detect_target(picture(spec, pose), parse_target(spec))

    assert found.corner_ids.tolist() == list(range(len(parse_target(spec).object_points)))
    assert np.sqrt(np.mean(errors(found, spec, pose) ** 2)) < 0.03


@CODED
@pytest.mark.parametrize("degrees", [(45, 0, 0), (-45, 0, 30), (0, 45, 0), (0, -45, 200), (32, 32, 100)])
def test_tilted_boards_are_found_whole_and_within_a_few_hundredths(
    spec: str, degrees: tuple[int, int, int]
) -> None:
    pose = pose_of(spec, degrees)
    found = detect_target(picture(spec, pose, clean=False), parse_target(spec))

    assert len(found.corner_ids) == len(parse_target(spec).object_points)
    assert np.sqrt(np.mean(errors(found, spec, pose) ** 2)) < 0.03
    assert found.parity_separation > 0.5
    assert found.contrast > 100
    assert 1.0 < found.sharpness.edge_width_px < 3.0


@CODED
def test_a_part_of_a_board_is_used_with_the_names_of_its_corners(spec: str) -> None:
    pose = pose_of(spec, (10.0, 5.0, 20.0), (0.16, -0.08, 0.4))
    found = detect_target(picture(spec, pose), parse_target(spec))

    truth = true_corners(scene_of(spec).scene, pose)
    inside = np.flatnonzero(np.all((truth > 9.0) & (truth < SIZE - 10.0), axis=1))
    assert 12 <= len(inside) < len(truth)
    assert set(inside) <= set(found.corner_ids.tolist())
    assert len(found.corner_ids) < len(truth)
    assert np.sqrt(np.mean(errors(found, spec, pose) ** 2)) < 0.03


@CODED
def test_what_a_hand_covers_is_left_out_and_the_rest_is_right(spec: str) -> None:
    pose = pose_of(spec, (5.0, 10.0, 0.0))
    image = picture(spec, pose)
    hand = true_corners(scene_of(spec).scene, pose)[0]
    cv2.circle(image, (int(hand[0]) - 20, int(hand[1]) - 10), 110, 90, -1, cv2.LINE_AA)
    found = detect_target(image, parse_target(spec))

    assert 0 not in found.corner_ids
    assert len(found.corner_ids) > 0.6 * len(parse_target(spec).object_points)
    # The corner beside the hand has its shadow in the blur.
    assert np.abs(errors(found, spec, pose)).max() < 0.3


@CODED
def test_a_mirrored_board_is_called_mirrored(spec: str) -> None:
    image = np.ascontiguousarray(picture(spec, pose_of(spec, (15.0, -10.0, 30.0)))[:, ::-1])
    with pytest.raises(WrongTarget, match="mirrored") as refused:
        detect_target(image, parse_target(spec))
    assert refused.value.facts["mirrored"] is True


@pytest.mark.parametrize(
    ("shown", "declared", "said"),
    [
        (CHARUCO, "charuco:9x4:25mm:18mm:4x4_250", "do not lie as on a 9x4 ChArUco board"),
        (CHARUCO, "charuco:8x3:25mm:18mm:4x4_250", "markers that a 8x3 ChArUco board does not have"),
        (CHARUCO, "charuco:8x5:25mm:18mm:5x5_250", "are of 4x4_1000"),
        (CHARUCO, APRILGRID, "are of 4x4_1000"),
        (APRILGRID, "aprilgrid:4x5:32mm:0.3", "do not lie as on a 4x5 AprilGrid"),
        (APRILGRID, "aprilgrid:5x3:32mm:0.3", "markers that a 5x3 AprilGrid does not have"),
        (APRILGRID, CHARUCO, "are of tag36h11 with a border of 2 cells"),
    ],
)
def test_another_board_is_refused_by_name(shown: str, declared: str, said: str) -> None:
    image = picture(shown, pose_of(shown, (10.0, 15.0, -25.0)))
    with pytest.raises(WrongTarget, match=said):
        detect_target(image, parse_target(declared))


@CODED
def test_no_board_and_too_little_of_one_say_what_to_do(spec: str) -> None:
    with pytest.raises(TargetNotVisible, match="No markers"):
        detect_target(scene_of(spec).background.astype(np.uint8), parse_target(spec))
    image = picture(spec, pose_of(spec, (0.0, 0.0, 0.0)))
    image[:, 550:] = 90
    image[:380] = 90
    with pytest.raises(TargetNotVisible, match="more of the board") as refused:
        detect_target(image, parse_target(spec))
    assert 0 < int(str(refused.value.facts["corners_seen"])) < 12


@CODED
def test_blur_shows_as_wide_edges_or_hides_the_markers(spec: str) -> None:
    sharp = picture(spec, pose_of(spec, (10.0, 15.0, -25.0)))
    blurred = np.asarray(cv2.GaussianBlur(sharp, (0, 0), 3.0), dtype=np.uint8)
    try:
        assert detect_target(blurred, parse_target(spec)).sharpness.edge_width_px > 3.5
    except TargetNotVisible as refused:
        assert "sharp" in refused.detail  # noqa: PT017


@pytest.mark.parametrize("legacy", [False, True])
def test_opencvs_own_board_is_found_and_its_legacy_pattern_refused(*, legacy: bool) -> None:
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_250)
    board = cv2.aruco.CharucoBoard((10, 6), 0.025, 0.018, dictionary)
    board.setLegacyPattern(legacy)
    image = np.full((600, 900), 255, np.uint8)
    image[60:540, 40:840] = board.generateImage((800, 480))
    image = np.asarray(0.9 * image, dtype=np.uint8)  # what a camera shows as 255 is overexposed
    declared = parse_target("charuco:9x5:25mm:18mm:4x4_250")
    if legacy:
        with pytest.raises(WrongTarget, match="do not lie"):
            detect_target(image, declared)
        return
    found = detect_target(image, declared)
    wanted = np.array(board.getChessboardCorners())[:, :2] / 0.025 * 80 + [39.5, 59.5]
    assert found.corner_ids.tolist() == list(range(45))
    np.testing.assert_allclose(found.image_points, wanted, atol=0.6)
