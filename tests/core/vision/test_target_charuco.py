"""ChArUco boards: the same as OpenCV's, and words that are refused with what to write."""

import cv2
import numpy as np
import pytest

from service.core.errors import TargetSpecInvalid
from service.core.vision.target_charuco import Charuco, parse_charuco
from tests.core.vision.printed_board import paint_print

BOARD = parse_charuco("charuco:8x5:25mm:18mm:4x4_250")


def opencvs(board: Charuco) -> cv2.aruco.CharucoBoard:
    """OpenCV's board, which counts squares."""
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_250)
    size = (board.columns + 1, board.rows + 1)
    return cv2.aruco.CharucoBoard(size, board.square_m, board.marker_m, dictionary)


def test_the_corners_are_opencvs_with_the_origin_at_the_first() -> None:
    theirs = np.array(opencvs(BOARD).getChessboardCorners())
    np.testing.assert_allclose(BOARD.object_points, theirs - theirs[0], atol=1e-8)


def test_the_print_is_opencvs() -> None:
    scale = 10000
    ours, _, _ = paint_print(BOARD, px_per_m=scale, border_m=0.0)
    theirs = opencvs(BOARD).generateImage((ours.shape[1], ours.shape[0]))
    differs = (np.abs(ours.astype(float) - theirs) > 100).astype(np.uint8)
    # Edges may be a pixel or two apart: no cell of 30 px may differ.
    assert cv2.erode(differs, np.ones((5, 5), np.uint8)).sum() == 0
    assert np.mean(ours < 128) == pytest.approx(np.mean(theirs < 128), abs=0.015)


def test_the_markers_are_where_opencv_has_them() -> None:
    theirs = np.array(opencvs(BOARD).getObjPoints())[..., :2] - BOARD.square_m
    np.testing.assert_allclose(BOARD.marker_corners, theirs, atol=1e-8)
    for marker, features in zip(BOARD.marker_corners, BOARD.marker_features, strict=True):
        away = np.abs(BOARD.object_points[list(features), :2] - marker.mean(axis=0))
        np.testing.assert_allclose(away, BOARD.square_m / 2)


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("charuco:8x5:25mm", "inner corners"),
        ("charuco:8x5:25:18:4x4_250", "SQUAREmm"),
        ("charuco:2x5:25mm:18mm:4x4_250", "3x3"),
        ("charuco:8x5:18mm:25mm:4x4_250", "square's size comes first"),
        ("charuco:8x5:25mm:5mm:4x4_250", "smaller than its squares"),
        ("charuco:8x5:25mm:18mm:9x9_250", "no dictionary"),
        ("charuco:15x9:25mm:18mm:4x4_50", "only 50"),
    ],
)
def test_words_that_are_no_board_say_what_to_write(spec: str, said: str) -> None:
    with pytest.raises(TargetSpecInvalid, match=said):
        parse_charuco(spec)
