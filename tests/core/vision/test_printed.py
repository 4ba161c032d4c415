"""Borders of dark cells as loops without seams."""

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from service.core.vision.printed import trace_cells


@given(arrays(bool, st.tuples(st.integers(1, 7), st.integers(1, 7))))
def test_loops_filled_by_the_even_odd_rule_are_the_cells(dark: np.ndarray) -> None:
    loops = trace_cells(dark)
    picture = np.zeros((dark.shape[0] * 8, dark.shape[1] * 8), np.uint8)
    if loops:
        cv2.fillPoly(picture, [np.rint(loop * 8).astype(np.int32) for loop in loops], 1)
    np.testing.assert_array_equal(picture[4::8, 4::8].astype(bool), dark)


def test_two_cells_beside_each_other_are_one_rectangle() -> None:
    (loop,) = trace_cells(np.array([[True, True]]))
    assert len(loop) == 4
