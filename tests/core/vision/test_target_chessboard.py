"""Chessboards and the words that describe them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.core.errors import TargetSpecInvalid
from service.core.vision.target import parse_target
from service.core.vision.target_chessboard import Chessboard

boards = st.builds(
    Chessboard, st.integers(3, 40), st.integers(3, 40), st.integers(1, 200).map(lambda mm: mm / 1000)
)


@given(boards)
def test_a_board_comes_back_from_its_words(board: Chessboard) -> None:
    again = parse_target(board.spec)
    assert (again.columns, again.rows) == (board.columns, board.rows)
    assert again.square_m == pytest.approx(board.square_m)


def test_corners_run_row_by_row_from_the_origin() -> None:
    points = Chessboard(9, 6, 0.025).object_points
    assert points.shape == (54, 3)
    np.testing.assert_allclose(
        points[[0, 1, 9, 53]], np.array([[0, 0, 0], [0.025, 0, 0], [0, 0.025, 0], [0.2, 0.125, 0]])
    )


def test_the_outer_corners_run_round_the_board_and_its_centre_is_their_mean() -> None:
    board = Chessboard(9, 6, 0.025)
    outer = board.object_points[list(board.outer_corners)]
    np.testing.assert_allclose(outer[:, :2], np.array([[0, 0], [0.2, 0], [0.2, 0.125], [0, 0.125]]))
    np.testing.assert_allclose(outer.mean(axis=0), board.centre)


def test_a_board_without_a_size_has_squares_of_one_metre() -> None:
    assert parse_target("chessboard:9x6") == Chessboard(9, 6, 1.0)


@pytest.mark.parametrize(("columns", "rows", "symmetric"), [(9, 6, False), (8, 6, True), (7, 5, True)])
def test_a_board_is_symmetric_when_both_counts_are_odd_or_both_even(
    columns: int, rows: int, symmetric: bool
) -> None:
    assert Chessboard(columns, rows, 0.025).is_symmetric is symmetric


@pytest.mark.parametrize(
    "spec",
    [
        "chessboard:9",
        "chessboard:2x6:25mm",
        "chessboard:9x6:0mm",
        "chessboard:9x6:25",
    ],
)
def test_words_that_are_no_target_say_what_to_write(spec: str) -> None:
    with pytest.raises(TargetSpecInvalid, match="chessboard"):
        parse_target(spec)
