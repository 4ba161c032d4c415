import numpy as np

from service.core.vision.corner_candidates import find_corners, inspect_rings
from service.core.vision.sampling import smooth
from tests.core.vision.drawn_board import draw_board


def test_every_corner_of_a_board_is_a_candidate() -> None:
    board = draw_board(roll_deg=25.0)
    found = find_corners(board.image(noise_grey=3.0)).points
    distance = np.linalg.norm(board.corners[:, None] - found, axis=-1).min(axis=1)
    assert distance.max() < 0.3


def test_candidates_are_bounded() -> None:
    noise = np.random.default_rng(1).integers(0, 256, (600, 800), dtype=np.uint8)
    assert len(find_corners(noise, limit=300)) <= 300


def test_slots_run_along_the_edges_and_begin_with_a_dark_square() -> None:
    board = draw_board(tilt=0.0)
    blurred = smooth(board.image(), 1.0)
    passed, corners = inspect_rings(blurred, board.corners, np.full(54, 6.0))
    assert passed.all()
    quarter = corners.slots / (np.pi / 2)
    assert np.abs(quarter - np.rint(quarter)).max() < 0.02
    middle = corners.slots[:, :2].mean(axis=1)
    spot = np.rint(board.corners + 12.0 * np.stack([np.cos(middle), np.sin(middle)], axis=-1)).astype(int)
    assert (board.image()[spot[:, 1], spot[:, 0]] < 60).all()


def test_an_edge_and_a_flat_place_are_no_corners() -> None:
    image = np.full((60, 60), 50, np.uint8)
    image[:, 30:] = 200
    passed, _ = inspect_rings(smooth(image, 1.0), np.array([[30.0, 30.0], [10.0, 30.0]]), np.full(2, 5.0))
    assert not passed.any()
