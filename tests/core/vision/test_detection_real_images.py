"""Photographs taken by others (shared/data/README.md): found, read in the right order, and nothing else."""

import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from service.core.errors import TargetNotVisible, WrongTarget
from service.core.vision.calibration import CalibrationResult, View, calibrate_intrinsics
from service.core.vision.detection import Detection, detect_target
from service.core.vision.target_chessboard import Chessboard
from tests.core.vision.drawn_board import Image

DATA = Path(__file__).parents[4] / "shared" / "data"
NINE_BY_SIX = Chessboard(9, 6, 1.0)
SIX_BY_FOUR = Chessboard(6, 4, 0.03)

pytestmark = [
    pytest.mark.data,
    pytest.mark.skipif(
        not DATA.is_dir() and "CI" not in os.environ, reason=f"the real images are not there: {DATA}"
    ),
]


def read(path: Path) -> Image:
    return np.asarray(cv2.imread(str(path), cv2.IMREAD_GRAYSCALE), dtype=np.uint8)


def names(pattern: str) -> list[Path]:
    paths = sorted(DATA.glob(pattern))
    assert paths, f"no images {pattern} in {DATA}"
    return paths


def detect_all(pattern: str, target: Chessboard) -> dict[str, Detection]:
    found = {}
    for path in names(pattern):
        try:
            found[path.stem] = detect_target(read(path), target)
        except TargetNotVisible:
            continue
    return found


def calibrate(
    found: dict[str, Detection], target: Chessboard, fixed: tuple[str, ...] = ()
) -> CalibrationResult:
    views = [View(target.object_points, detection.image_points, name) for name, detection in found.items()]
    return calibrate_intrinsics(views, next(iter(found.values())).image_size, fixed=fixed)


@pytest.mark.parametrize(
    ("side", "expected"), [("left", (532.9, 533.0, 342.4, 233.9)), ("right", (537.4, 537.0, 327.3, 249.0))]
)
def test_the_opencv_pictures_give_the_published_camera(side: str, expected: tuple[float, ...]) -> None:
    found = detect_all(f"opencv_left_right/{side}*.jpg", NINE_BY_SIX)
    assert len(found) == 13
    result = calibrate(found, NINE_BY_SIX)
    assert result.rms_px <= 0.175
    assert result.intrinsics.vector[:4] == pytest.approx(expected, abs=1.5)


def test_the_sony_pictures_give_the_published_camera() -> None:
    found = detect_all("boofcv_sony_chess/*.jpg", SIX_BY_FOUR)
    assert len(found) == 13
    result = calibrate(found, SIX_BY_FOUR, fixed=("k3", "p1", "p2"))
    assert result.intrinsics.vector[:4] == pytest.approx((701.0, 698.7, 308.5, 246.8), abs=2.0)


@pytest.mark.parametrize(
    ("pattern", "target", "whole"),
    [
        ("udacity_lanes_9x6/*.jpg", NINE_BY_SIX, 18),
        ("boofcv_fisheye_chess/*.jpg", SIX_BY_FOUR, 26),
        ("caliscope_chess_intrinsic/*.jpg", NINE_BY_SIX, 6),
    ],
)
def test_whole_boards_are_found(pattern: str, target: Chessboard, whole: int) -> None:
    found = detect_all(pattern, target)
    assert len(found) == whole
    assert min(detection.parity_separation for detection in found.values()) >= 0.5
    assert min(detection.contrast for detection in found.values()) >= 90.0


@pytest.mark.parametrize(
    "name",
    [
        "udacity_lanes_9x6/calibration1",  # a row is cut off by the border
        "udacity_lanes_9x6/calibration5",  # two corners are
        "caliscope_chess_intrinsic/cam_0_frame_000",  # a row is
        "caliscope_chess_intrinsic/cam_3_frame_1070",  # a finger covers two corners
    ],
)
def test_a_board_that_is_cut_off_or_covered_is_told_by_its_corners(name: str) -> None:
    with pytest.raises(TargetNotVisible, match="of 54 corners") as caught:
        detect_target(read(DATA / f"{name}.jpg"), NINE_BY_SIX)
    assert 45 <= int(str(caught.value.facts["corners_seen"])) < 54


@pytest.mark.parametrize("target", [NINE_BY_SIX, SIX_BY_FOUR, Chessboard(3, 3, 1.0)], ids=str)
def test_nothing_is_found_on_roads(target: Chessboard) -> None:
    assert detect_all("neg_udacity_road/*.jpg", target) == {}


@pytest.mark.parametrize(("columns", "rows"), [(8, 6), (7, 6)])
def test_a_board_declared_too_small_is_the_wrong_target_in_every_picture(columns: int, rows: int) -> None:
    for path in names("opencv_left_right/*.jpg"):
        with pytest.raises(WrongTarget) as caught:
            detect_target(read(path), Chessboard(columns, rows, 1.0))
        assert (caught.value.facts["found_columns"], caught.value.facts["found_rows"]) == (9, 6), path


def test_a_blurred_lens_shows_in_the_edge_width() -> None:
    image = read(DATA / "opencv_left_right" / "left01.jpg")
    sharp = detect_target(image, NINE_BY_SIX).sharpness.edge_width_px
    soft = detect_target(
        np.asarray(cv2.GaussianBlur(image, (0, 0), 3.0)), NINE_BY_SIX
    ).sharpness.edge_width_px
    assert 1.7 < sharp < 2.9
    assert 7.5 < soft < 9.0
