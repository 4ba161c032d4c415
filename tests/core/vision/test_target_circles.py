"""Grids of circles: OpenCV's definition, and words that are refused with what to write."""

import numpy as np
import pytest

from service.core.errors import TargetSpecInvalid
from service.core.vision.target_circles import parse_circles


def test_dots_are_where_opencv_has_them() -> None:
    # As in its calibration sample: (2 j + i % 2, i) steps, row by row.
    theirs = [((2 * j + i % 2) * 0.02, i * 0.02, 0.0) for i in range(11) for j in range(4)]
    np.testing.assert_allclose(parse_circles("circles:4x11:20mm").object_points, theirs)


def test_without_a_diameter_dots_are_half_a_step_wide() -> None:
    assert parse_circles("circles:4x11:20mm").spec == "circles:4x11:20mm:10mm"


@pytest.mark.parametrize(("spec", "symmetric"), [("circles:4x11:20mm", False), ("circles:4x10:20mm", True)])
def test_an_even_number_of_rows_looks_the_same_turned_by_half(spec: str, *, symmetric: bool) -> None:
    assert parse_circles(spec).is_symmetric is symmetric


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("circles:4x11", "STEPmm"),
        ("circles:4x11:20", "STEPmm"),
        ("circles:2x11:20mm", "3 rows of 3 dots"),
        ("circles:4x11:20mm:30mm", "diameter"),
        ("circles:4x11:0mm", "diameter"),
    ],
)
def test_words_that_are_no_grid_say_what_to_write(spec: str, said: str) -> None:
    with pytest.raises(TargetSpecInvalid, match=said):
        parse_circles(spec)
