"""A drawn board in a live frame is found in the right order, or it is said what the frame shows instead."""

import numpy as np
import pytest

from service.core.errors import Unprocessable
from service.core.vision.live_detection import LiveDetection, LiveWorkspace, detect_live
from service.core.vision.sharpness import measure_sharpness
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from tests.core.vision.drawn_board import DrawnBoard, Image, blur, draw_board, to_image

NINE_BY_SIX = Chessboard(9, 6, 0.025)


def halved(image: Image) -> Image:
    """Return the means of 2x2 pixels, as a page sends them."""
    rows, columns = (size // 2 for size in image.shape)
    return to_image(image[: 2 * rows, : 2 * columns].reshape(rows, 2, columns, 2).mean(axis=(1, 3)))


def rms_px(detection: LiveDetection, board: DrawnBoard) -> float:
    assert detection.kind == "present"
    assert detection.image_points is not None
    error = np.linalg.norm(detection.image_points - board.corners, axis=1)
    return float(np.sqrt(np.mean(error**2)))


def cut_at(board: DrawnBoard, column: float) -> Image:
    """Return the picture from a column on, half a square further than that column of corners."""
    x = board.corners.reshape(board.target.rows, board.target.columns, 2)[:, :, 0].mean(axis=0)
    return np.ascontiguousarray(board.image(2.0)[:, int(np.interp(column, np.arange(len(x)), x)) :])


@pytest.mark.parametrize("roll_deg", range(-180, 180, 15))
def test_corners_are_in_order_and_within_a_tenth_of_a_pixel_at_any_roll(roll_deg: int) -> None:
    board = draw_board(square_px=30.0, roll_deg=roll_deg)
    assert rms_px(detect_live(board.image(2.0), board.target), board) < 0.1


@pytest.mark.parametrize("square_px", [13.0, 18.0, 25.0, 44.0])
def test_small_and_large_squares_are_found(square_px: float) -> None:
    board = draw_board(square_px=square_px, roll_deg=10.0)
    assert rms_px(detect_live(board.image(2.0), board.target), board) < 0.3


def test_a_frame_sent_at_half_size_gives_corners_in_full_size_pixels() -> None:
    board = draw_board(roll_deg=20.0)
    assert rms_px(detect_live(halved(board.image(2.0)), board.target, scale=2), board) < 0.1


def test_an_odd_picture_size_moves_no_corner() -> None:
    board = draw_board()
    odd = np.ascontiguousarray(board.image()[:479, :639])
    assert rms_px(detect_live(odd, board.target), board) < 0.1


def test_a_dark_a_blurred_and_a_noisy_board_are_found() -> None:
    dim = draw_board(white=42.0, dark=12.0)
    assert rms_px(detect_live(dim.image(1.0), dim.target), dim) < 0.3
    soft = draw_board(sigma_px=3.5)
    assert rms_px(detect_live(soft.image(2.0), soft.target), soft) < 0.3
    board = draw_board()
    assert rms_px(detect_live(board.image(12.0), board.target), board) < 0.3


@pytest.mark.parametrize(("columns", "rows"), [(8, 6), (5, 5), (4, 3), (3, 3)])
def test_a_symmetric_board_held_upright_starts_at_its_upper_left(columns: int, rows: int) -> None:
    board = draw_board(columns, rows, roll_deg=15.0)
    assert rms_px(detect_live(board.image(2.0), board.target), board) < 0.1


def test_a_board_that_the_border_cuts_is_partial_from_twenty_corners_on() -> None:
    board = draw_board()
    partial = detect_live(cut_at(board, 3.5), board.target)
    assert (partial.kind, partial.image_points) == ("partial", None)
    assert 20 <= partial.corners_seen <= 30
    few = detect_live(cut_at(board, 6.5), board.target)
    assert few.kind == "absent"


def test_a_board_with_a_covered_corner_is_partial() -> None:
    board = draw_board()
    image = board.image(2.0)
    x, y = board.corners[0].astype(int)
    image[y - 60 : y + 20, x - 60 : x + 20] = 128
    detection = detect_live(image, board.target)
    assert detection.kind == "partial"
    assert 40 <= detection.corners_seen <= 53


@pytest.mark.parametrize(
    "declared", [Chessboard(8, 6, 0.025), Chessboard(9, 5, 0.025), Chessboard(4, 3, 0.025)]
)
def test_a_larger_board_than_declared_is_wrong(declared: Chessboard) -> None:
    detection = detect_live(draw_board(roll_deg=30.0).image(2.0), declared)
    assert (detection.kind, detection.image_points) == ("wrong", None)


def test_a_smaller_board_than_declared_is_partial() -> None:
    assert detect_live(draw_board(7, 5).image(2.0), NINE_BY_SIX).kind == "partial"


def test_noise_and_an_even_frame_show_no_board() -> None:
    noise = np.random.default_rng(4).integers(0, 256, (480, 640), dtype=np.uint8)
    for sigma in (0.6, 2.0, 4.0):
        assert detect_live(blur(noise, sigma), NINE_BY_SIX).kind == "absent"
    even = detect_live(np.full((480, 640), 77, np.uint8), NINE_BY_SIX)
    assert (even.kind, even.corners_seen, even.edge_width_px) == ("absent", 0, None)
    assert even.brightness == pytest.approx(77.0)


def test_a_workspace_changes_nothing_from_frame_to_frame_and_from_size_to_size() -> None:
    workspace = LiveWorkspace()
    for board in (draw_board(), draw_board(roll_deg=170.0), draw_board(centre=(300.0, 220.0))):
        for image in (board.image(2.0), np.ascontiguousarray(board.image(2.0)[:460])):
            kept, fresh = detect_live(image, board.target, workspace), detect_live(image, board.target)
            assert kept.image_points is not None
            np.testing.assert_array_equal(kept.image_points, fresh.image_points)
            assert (kept.edge_width_px, kept.brightness) == (fresh.edge_width_px, fresh.brightness)


@pytest.mark.parametrize("sigma_px", [0.8, 1.5, 3.0])
def test_the_edge_width_is_that_of_a_capture_to_a_seventh(sigma_px: float) -> None:
    board = draw_board(sigma_px=sigma_px)
    corners: Array = board.corners.reshape(6, 9, 2)
    truth = measure_sharpness(board.image().astype(np.float32), corners).edge_width_px
    assert detect_live(board.image(2.0), board.target).edge_width_px == pytest.approx(truth, rel=0.15)


def test_brightness_is_the_level_of_the_bright_squares() -> None:
    board = draw_board(white=180.0, dark=30.0, roll_deg=160.0)
    assert detect_live(board.image(2.0), board.target).brightness == pytest.approx(180.0, abs=2.0)


@pytest.mark.parametrize(
    "image", [np.zeros((40, 40, 3), np.uint8), np.zeros((40, 40)), np.zeros((9, 9), np.uint8)]
)
def test_what_is_no_grey_image_is_refused(image: Image) -> None:
    with pytest.raises(Unprocessable):
        detect_live(image, NINE_BY_SIX)
