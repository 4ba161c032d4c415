"""Polynomials of lens models: their first positive root, and whether they are positive up to a place."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.core.vision.polynomial import is_positive_up_to, smallest_positive_root


@pytest.mark.parametrize(
    ("ascending", "root"),
    [
        ([1.0, -0.5, 0.0, 0.0], 2.0),
        ([1.0, -1.5, 0.5], 1.0),
        ([1.0, 0.0, 0.25], math.inf),
        ([1.0, 3.0, 2.0, 0.0, 0.0], math.inf),
    ],
)
def test_the_first_positive_root_is_found_where_there_is_one(ascending: list[float], root: float) -> None:
    assert smallest_positive_root(ascending) == pytest.approx(root)


@settings(deadline=None)
@given(
    higher=st.lists(st.floats(-3.0, 3.0).map(lambda a: round(a, 2)), min_size=2, max_size=6),
    end=st.floats(0.01, 4.0),
)
def test_positive_up_to_a_place_is_what_the_first_root_says(higher: list[float], end: float) -> None:
    ascending = [1.0, *higher]
    root = smallest_positive_root(ascending)
    # On the root itself, or where the curve only touches zero, rounding decides.
    values = np.polynomial.polynomial.polyval(np.linspace(0.0, end, 400), ascending)
    if abs(root - end) > 1e-6 and abs(values.min()) > 1e-6:
        assert is_positive_up_to(ascending, end) == (root > end)
