"""Views become arrays, or say what is wrong with them."""

import numpy as np
import pytest

from service.core.errors import DegenerateViews, TooFewViews
from service.core.vision.view_stack import View, stack_views
from tests.core.vision.cameras import BOARD, LENS1, views_of


def test_unequal_views_are_padded_with_weight_zero() -> None:
    views = views_of(LENS1, 3, seed=1)
    views[1] = View(views[1].object_points[:20], views[1].image_points[:20])
    stack = stack_views(views)
    assert stack.counts == (54, 20, 54)
    assert stack.measurements == 2 * 128
    assert stack.is_weighted
    assert stack.weights.sum() == 128
    np.testing.assert_array_equal(stack.image_points[1, :20], views[1].image_points)


def test_thinning_keeps_views_that_are_already_small() -> None:
    views = [View(view.object_points[:12], view.image_points[:12]) for view in views_of(LENS1, 3, seed=2)]
    assert stack_views(views).thinned(16).counts == (12, 12, 12)
    assert stack_views(views_of(LENS1, 3, seed=2)).thinned(16).counts == (16, 16, 16)


def test_a_plate_need_not_be_quite_flat() -> None:
    views = views_of(LENS1, 3, seed=2)
    bowed = [
        View(view.object_points + np.outer(view.object_points[:, 0] ** 2, [0, 0, 0.1]), view.image_points)
        for view in views
    ]
    assert np.ptp(stack_views(bowed).object_points[..., 2]) > 0.001


def test_two_views_are_too_few() -> None:
    with pytest.raises(TooFewViews) as caught:
        stack_views(views_of(LENS1, 2, seed=3))
    assert caught.value.facts == {"views_found": 2, "views_needed": 3}


def spoiled(kind: str) -> View:
    board, image = BOARD.object_points.copy(), views_of(LENS1, 1, seed=4)[0].image_points.copy()
    if kind == "nan":
        image[3, 1] = np.nan
    elif kind == "bent":
        board[5, 2] = 0.02
    elif kind == "line":
        image[:, 1] = 400.0
    elif kind == "few":
        board, image = board[:5], image[:5]
    elif kind == "unequal":
        image = image[:50]
    return View(board, image, "spoiled.png")


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("nan", "finite"),
        ("bent", "plane"),
        ("line", "line"),
        ("few", "at least 6"),
        ("unequal", "image points"),
    ],
)
def test_an_unusable_view_is_named_with_its_reason(kind: str, words: str) -> None:
    with pytest.raises(DegenerateViews, match=words) as caught:
        stack_views([*views_of(LENS1, 3, seed=5), spoiled(kind)])
    assert caught.value.facts == {"view": "spoiled.png"}
