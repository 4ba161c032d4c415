"""Candidates of a live frame: every corner of a board, few others, and never more than are looked at."""

import numpy as np
import pytest

from service.core.vision.live_corners import (
    CANDIDATES,
    LiveWorkspace,
    find_live_corners,
    refine_on_pixels,
    smooth_frame,
)
from service.core.vision.transforms import Array
from tests.core.vision.drawn_board import blur, draw_board


def _nearest_px(points: Array, truth: Array) -> Array:
    return np.asarray(np.linalg.norm(points[None] - truth[:, None], axis=-1).min(axis=1))


@pytest.mark.parametrize("square_px", [8.0, 12.0, 20.0, 40.0])
def test_every_corner_of_a_board_is_a_candidate(square_px: float) -> None:
    board, workspace = draw_board(square_px=square_px, roll_deg=20.0), LiveWorkspace()
    corners = find_live_corners(smooth_frame(board.image(2.0), workspace), workspace)
    assert _nearest_px(corners.points, board.corners).max() < 0.4
    assert len(corners) < 80


def test_noise_gives_no_more_candidates_than_are_looked_at() -> None:
    workspace = LiveWorkspace()
    noise = blur(np.random.default_rng(2).integers(0, 256, (400, 640), dtype=np.uint8), 1.5)
    assert len(find_live_corners(smooth_frame(noise, workspace), workspace)) <= CANDIDATES


def test_an_even_frame_gives_no_candidate() -> None:
    workspace = LiveWorkspace()
    even = smooth_frame(np.full((400, 640), 90, np.uint8), workspace)
    assert len(find_live_corners(even, workspace)) == 0


def test_saddles_on_whole_pixels_are_within_a_seventh_of_a_pixel() -> None:
    board, workspace = draw_board(square_px=30.0, roll_deg=33.0), LiveWorkspace()
    blurred = smooth_frame(board.image(), workspace)
    radii = np.where(np.arange(54) % 2 == 0, 2, 5)  # discs larger than 3 px are cut down to that
    points, proven = refine_on_pixels(blurred, board.corners + 0.8, radii)
    assert proven.all()
    assert np.abs(points - board.corners).max() < 0.15


def test_a_point_on_a_plain_edge_or_outside_is_not_proven_and_stays() -> None:
    board, workspace = draw_board(square_px=40.0, tilt=0.0), LiveWorkspace()
    blurred = smooth_frame(board.image(), workspace)
    middle_of_an_edge = 0.5 * (board.corners[0] + board.corners[1])
    start = np.array([middle_of_an_edge, [1.0, 1.0], [5.0, 5.0]])
    points, proven = refine_on_pixels(blurred, start, np.full(3, 2))
    assert not proven.any()
    np.testing.assert_array_equal(points, start)


def test_buffers_are_kept_for_a_size_and_new_for_another() -> None:
    workspace = LiveWorkspace()
    first = workspace.floats("a", (4, 5))
    assert workspace.floats("a", (4, 5)) is first
    assert workspace.floats("b", (4, 5)) is not first
    assert workspace.floats("a", (5, 5)).shape == (5, 5)
