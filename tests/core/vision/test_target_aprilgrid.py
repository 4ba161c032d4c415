"""AprilGrids: the same as Kalibr prints, and words that are refused with what to write."""

import numpy as np
import pytest

from service.core.errors import TargetSpecInvalid
from service.core.vision.target_aprilgrid import parse_aprilgrid
from service.core.vision.transforms import Array
from tests.core.vision.printed_board import paint_print

GRID = parse_aprilgrid("aprilgrid:3x2:100mm:0.3")
# The first tags of tag36h11 as kalibr_create_target_pdf has them.
KALIBRS_CODES = (0xD5D628584, 0xD97F18B49, 0xDD280910E, 0xE479E9C98, 0xEBCBCA822, 0xF31DAB3AC)


def kalibrs_cells(code: int) -> Array:
    """What is dark (10, 10) of a tag, row 0 on top, as kalibr_create_target_pdf draws it."""
    bits = np.array([[not code >> (6 * i + j) & 1 for j in range(6)] for i in range(6)])
    return np.pad(np.rot90(bits, 2), 2, constant_values=True).astype(np.float64)


def test_the_print_is_kalibrs() -> None:
    picture, origin, scale = paint_print(GRID, px_per_m=1000, border_m=0.0)
    pitch, middles = 0.13, (np.arange(10) + 0.5) * 0.01
    for tag, code in enumerate(KALIBRS_CODES):
        up, right = divmod(tag, 3)
        x, y = right * pitch + middles - origin[0], (1 - up) * pitch + middles - origin[1]
        seen = picture[np.ix_(np.rint(y * scale).astype(int), np.rint(x * scale).astype(int))]
        np.testing.assert_array_equal(seen < 128, kalibrs_cells(code) > 0.5, str(tag))
    crossings = [(x, y) for x in (-0.015, 0.115, 0.245, 0.375) for y in (-0.015, 0.115, 0.245)]
    gaps = [(x, y) for x in (0.05, 0.18) for y in (-0.015, 0.115, 0.245)]
    for places, is_dark in ((crossings, True), (gaps, False)):
        for x, y in places:
            level = picture[round((y - origin[1]) * scale), round((x - origin[0]) * scale)]
            assert (level < 128) == is_dark, (x, y)


def test_corners_run_from_the_top_left_and_tags_from_the_bottom_left() -> None:
    assert (GRID.columns, GRID.rows) == (6, 4)
    np.testing.assert_allclose(GRID.object_points[:4, 0], [0.0, 0.1, 0.13, 0.23])
    np.testing.assert_allclose(GRID.object_points[::6, 1], [0.0, 0.1, 0.13, 0.23])
    assert GRID.marker_features[0] == (12, 13, 19, 18)
    assert GRID.marker_features[5] == (4, 5, 11, 10)


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("aprilgrid:6x6:24mm", "the gap as a share"),
        ("aprilgrid:6x6:24mm:30%", "the gap as a share"),
        ("aprilgrid:1x6:24mm:0.3", "at least 2x2"),
        ("aprilgrid:6x6:24mm:7.2", "spacing from 0.1 to 1"),
        ("aprilgrid:30x20:24mm:0.3", "only 587"),
    ],
)
def test_words_that_are_no_grid_say_what_to_write(spec: str, said: str) -> None:
    with pytest.raises(TargetSpecInvalid, match=said):
        parse_aprilgrid(spec)
