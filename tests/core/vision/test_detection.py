"""A drawn board is found whole, exact and in the right order, or it is said why not."""

import numpy as np
import pytest
from numpy.typing import NDArray

from service.core.errors import TargetNotVisible, Unprocessable, WrongTarget
from service.core.vision.detection import Detection, detect_target
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array
from tests.core.vision.drawn_board import Image, blur, draw_board, to_image

NINE_BY_SIX = Chessboard(9, 6, 0.025)


def errors_px(detection: Detection, truth: Array) -> NDArray[np.float64]:
    return np.asarray(np.linalg.norm(detection.image_points - truth, axis=1))


def test_corners_of_a_clean_board_are_exact_to_hundredths_of_a_pixel() -> None:
    board = draw_board(roll_deg=12.0)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners).mean() < 0.015
    assert errors_px(detection, board.corners).max() < 0.05


def test_a_detection_tells_ids_size_parity_and_contrast() -> None:
    board = draw_board(white=190.0, dark=50.0)
    detection = detect_target(board.image(), board.target)
    assert detection.corner_ids.tolist() == list(range(54))
    assert detection.image_size == (640, 480)
    assert detection.parity_separation > 0.95
    assert detection.contrast == pytest.approx(140.0, abs=4.0)


@pytest.mark.parametrize("roll_deg", range(-180, 180, 15))
def test_the_order_of_corners_is_right_whichever_way_up_the_board_is(roll_deg: int) -> None:
    board = draw_board(square_px=30.0, roll_deg=roll_deg)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners).max() < 0.1


def test_a_board_declared_with_rows_and_columns_exchanged_is_the_same_board() -> None:
    board = draw_board(6, 9, square_px=30.0)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners).max() < 0.1


@pytest.mark.parametrize(("columns", "rows"), [(8, 6), (7, 5), (6, 6), (7, 7), (5, 5), (3, 3), (4, 3)])
@pytest.mark.parametrize("roll_deg", [-20.0, 20.0])
def test_a_symmetric_board_held_upright_starts_at_its_upper_left(
    columns: int, rows: int, roll_deg: float
) -> None:
    board = draw_board(columns, rows, roll_deg=roll_deg)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners).max() < 0.1


def test_a_symmetric_board_upside_down_is_read_as_if_it_were_upright() -> None:
    board = draw_board(8, 6, roll_deg=170.0)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners[::-1]).max() < 0.1


def test_a_square_board_keeps_the_dark_square_outside_its_first_corner() -> None:
    """Turned by 80 degrees, the upright choice would be a quarter turn away, but its square is bright."""
    board = draw_board(7, 7, square_px=32.0, roll_deg=80.0)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners).max() < 0.1


@pytest.mark.parametrize(("columns", "rows"), [(8, 6), (9, 7), (6, 6)])
def test_a_symmetric_board_printed_with_bright_corners_is_found(columns: int, rows: int) -> None:
    board = draw_board(columns, rows, white=40.0, dark=205.0)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners).max() < 0.1
    assert detection.parity_separation > 0.9
    assert detection.contrast > 150.0


def test_a_board_printed_in_exchanged_colours_is_read_from_its_other_end() -> None:
    board = draw_board(white=40.0, dark=205.0)
    detection = detect_target(board.image(), board.target)
    assert errors_px(detection, board.corners[::-1]).max() < 0.1


def test_a_view_into_an_array_is_as_good_as_a_copy() -> None:
    board = draw_board(roll_deg=10.0)
    view = np.stack([board.image()] * 2, axis=-1)[::-1, :, 0]
    assert np.array_equal(
        detect_target(view, board.target).image_points,
        detect_target(view.copy(), board.target).image_points,
    )


@pytest.mark.parametrize(("columns", "rows"), [(9, 6), (8, 6), (7, 7)])
def test_a_mirrored_picture_never_gives_a_mirrored_order(columns: int, rows: int) -> None:
    board = draw_board(columns, rows)
    detection = detect_target(np.ascontiguousarray(board.image()[:, ::-1]), board.target)
    points = detection.image_points.reshape(rows, columns, 2)
    x, y = points[0, -1] - points[0, 0], points[-1, 0] - points[0, 0]
    assert x[0] * y[1] - x[1] * y[0] > 0


@pytest.mark.parametrize(("columns", "rows"), [(8, 6), (7, 6), (9, 5), (8, 5), (5, 4), (3, 3), (7, 7)])
def test_a_larger_board_than_declared_is_the_wrong_target(columns: int, rows: int) -> None:
    with pytest.raises(WrongTarget, match="9x6") as caught:
        detect_target(draw_board().image(), Chessboard(columns, rows, 0.025))
    assert (caught.value.facts["found_columns"], caught.value.facts["found_rows"]) == (9, 6)


@pytest.mark.parametrize(("columns", "rows"), [(10, 6), (9, 7), (12, 9)])
def test_a_smaller_board_than_declared_is_told_by_the_corners_seen(columns: int, rows: int) -> None:
    with pytest.raises(TargetNotVisible, match=f"54 of {columns * rows}") as caught:
        detect_target(draw_board().image(), Chessboard(columns, rows, 0.025))
    assert caught.value.facts == {"corners_seen": 54, "corners_needed": columns * rows}


def test_a_board_that_is_cut_off_by_the_border_is_refused_with_what_to_do() -> None:
    board = draw_board(centre=(230.0, 240.0), square_px=60.0)
    with pytest.raises(TargetNotVisible, match="bring the whole board into the picture"):
        detect_target(board.image(), board.target)


def test_a_covered_corner_is_missed_and_said() -> None:
    board = draw_board()
    image = board.image()
    x, y = board.corners[22].astype(int)
    image[y - 18 : y + 18, x - 18 : x + 18] = 120
    with pytest.raises(TargetNotVisible, match="53 of 54"):
        detect_target(image, board.target)


def test_a_larger_board_of_which_a_line_is_half_hidden_is_refused_but_not_named() -> None:
    board = draw_board()
    image = board.image()
    for x, y in board.corners.reshape(6, 9, 2)[:2, 8].astype(int):
        image[y - 12 : y + 12, x - 12 : x + 12] = 120
    with pytest.raises(TargetNotVisible, match="not clearly enough to say which board it is"):
        detect_target(image, Chessboard(8, 6, 0.025))


@pytest.mark.parametrize("sigma_px", [3.0, 5.0, 6.5])
def test_the_rim_of_a_blurred_board_on_a_dark_ground_is_no_further_line(sigma_px: float) -> None:
    board = draw_board(square_px=34.0, tilt=2e-4)
    image = board.image()
    image[image == 122] = 15  # the surroundings
    detection = detect_target(blur(image, sigma_px), board.target)
    assert errors_px(detection, board.corners).max() < 0.5


@pytest.mark.parametrize("square_px", [9.0, 12.0, 20.0])
def test_tiny_squares_are_found(square_px: float) -> None:
    board = draw_board(square_px=square_px, sigma_px=0.6)
    assert errors_px(detect_target(board.image(noise_grey=2.0), board.target), board.corners).max() < 0.2


def test_huge_squares_are_found() -> None:
    board = draw_board(4, 3, square_px=120.0, tilt=2e-4)
    assert errors_px(detect_target(board.image(noise_grey=2.0), board.target), board.corners).max() < 0.1


@pytest.mark.parametrize("noise_grey", [4.0, 10.0, 16.0])
def test_a_board_is_found_in_noise(noise_grey: float) -> None:
    board = draw_board(roll_deg=20.0)
    detection = detect_target(board.image(noise_grey), board.target)
    assert errors_px(detection, board.corners).mean() < 0.01 + 0.01 * noise_grey


@pytest.mark.parametrize(("white", "dark"), [(24.0, 6.0), (140.0, 115.0), (250.0, 232.0)])
def test_a_board_is_found_in_the_dark_and_with_little_contrast(white: float, dark: float) -> None:
    board = draw_board(white=white, dark=dark)
    detection = detect_target(board.image(noise_grey=1.0), board.target)
    assert errors_px(detection, board.corners).mean() < 0.1


def test_a_defocused_board_is_found_and_its_edges_are_wide() -> None:
    board = draw_board(sigma_px=0.6)
    detection = detect_target(blur(board.image(noise_grey=2.0), 3.0), board.target)
    assert errors_px(detection, board.corners).mean() < 0.1
    assert detection.sharpness.edge_width_px == pytest.approx(2.563 * 3.06, rel=0.08)


def test_light_that_falls_off_moves_no_corner() -> None:
    board = draw_board()
    x = np.linspace(1.2, 0.25, 640)
    detection = detect_target(to_image(board.light() * x), board.target)
    assert errors_px(detection, board.corners).mean() < 0.03
    assert detection.parity_separation > 0.8


def negatives() -> dict[str, Image]:
    rng = np.random.default_rng(3)
    y, x = np.mgrid[:480, :640]
    return {
        "plain": np.full((480, 640), 128, np.uint8),
        "noise": rng.integers(0, 256, (480, 640), dtype=np.uint8),
        "stripes": to_image(128 + 100 * np.sign(np.sin(x / 9.0 + y / 31.0))),
        "dots": to_image(220 - 190.0 * ((x % 40 - 20) ** 2 + (y % 40 - 20) ** 2 < 120)),
        "lattice": to_image(220 - 190.0 * ((x % 40 < 6) | (y % 40 < 6))),
        "blobs": blur(rng.integers(0, 256, (480, 640), dtype=np.uint8), 4.0) * np.uint8(4),
    }


@pytest.mark.parametrize("name", list(negatives()))
def test_nothing_is_found_where_there_is_no_chessboard(name: str) -> None:
    with pytest.raises(TargetNotVisible):
        detect_target(negatives()[name], Chessboard(6, 4, 0.025))


def test_a_checkered_cloth_is_not_the_declared_board() -> None:
    y, x = np.mgrid[:800, :1280]
    cloth = to_image(128 + 90.0 * np.sign(np.sin(x / 6.0 + y / 41.0) * np.sin(y / 6.0 - x / 43.0)))
    with pytest.raises((WrongTarget, TargetNotVisible)):
        detect_target(cloth, NINE_BY_SIX)


def test_a_small_second_board_in_the_background_is_no_rival() -> None:
    board = draw_board(square_px=44.0, centre=(360.0, 260.0))
    small = draw_board(7, 5, square_px=7.0, centre=(50.0, 35.0), sigma_px=0.6).image()
    image = board.image()
    image[:70, :100] = small[:70, :100]
    assert errors_px(detect_target(image, board.target), board.corners).max() < 0.1
    with pytest.raises(WrongTarget, match="9x6"):
        detect_target(image, Chessboard(7, 5, 0.025))


@pytest.mark.parametrize(
    "array", [np.zeros((480, 640, 3), np.uint8), np.zeros((480, 640), np.uint16), np.zeros((480,), np.uint8)]
)
def test_an_array_that_is_no_grey_image_is_refused(array: NDArray[np.uint8]) -> None:
    with pytest.raises(Unprocessable, match="grey image of 8 bits"):
        detect_target(array, NINE_BY_SIX)


def test_an_image_too_small_for_any_board_is_refused() -> None:
    with pytest.raises(Unprocessable, match="at least 32x32 px; this one is 640x31"):
        detect_target(np.zeros((31, 640), np.uint8), NINE_BY_SIX)


@pytest.mark.parametrize("gap_px", [6.0, 8.0])
def test_a_corner_close_to_the_border_is_found_and_right(gap_px: float) -> None:
    # The squares are large, so that rings and discs of their usual size would leave the image.
    centre = (3 * 70.0 + gap_px, 2 * 70.0 + gap_px)
    board = draw_board(7, 5, square_px=70.0, tilt=0.0, centre=centre, sigma_px=0.9)
    detection = detect_target(board.image(), board.target)
    assert board.corners.min() == pytest.approx(gap_px)
    assert errors_px(detection, board.corners).max() < 0.15
