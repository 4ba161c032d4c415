import numpy as np
import pytest

from service.core.vision.saddle import refine_saddles
from service.core.vision.sampling import FloatImage, sample_bilinear, smooth
from tests.core.vision.drawn_board import draw_board


def surface(x0: float, y0: float, xx: float = 1.0, xy: float = 0.3, yy: float = -0.8) -> FloatImage:
    y, x = np.mgrid[:40, :50].astype(np.float64)
    u, v = x - x0, y - y0
    return np.asarray(xx * u * u + xy * u * v + yy * v * v + 7.0, dtype=np.float32)


def test_a_hyperbolic_surface_is_found_from_two_pixels_away() -> None:
    points, proven = refine_saddles(surface(24.37, 17.61), np.array([[26.0, 16.0]]), np.array([4]))
    assert proven.all()
    assert points[0] == pytest.approx((24.37, 17.61), abs=0.01)


def test_a_hill_is_no_saddle_and_comes_back_as_given() -> None:
    given = np.array([[24.0, 17.0]])
    points, proven = refine_saddles(surface(24.4, 17.6, yy=0.8), given, np.array([4]))
    assert not proven.any()
    assert points.tolist() == given.tolist()


def test_a_saddle_far_away_is_not_claimed() -> None:
    _, proven = refine_saddles(surface(40.0, 20.0), np.array([[12.0, 20.0]]), np.array([3]))
    assert not proven.any()


@pytest.mark.parametrize("point", [(2.0, 20.0), (47.5, 20.0), (20.0, 1.0), (20.0, 38.0)])
def test_a_disc_that_leaves_the_image_is_not_proven(point: tuple[float, float]) -> None:
    _, proven = refine_saddles(surface(*point), np.array([point]), np.array([4]))
    assert not proven.any()


def test_each_point_has_its_own_radius() -> None:
    board = draw_board()
    radii = np.resize([2, 3, 5], 54)
    points, proven = refine_saddles(smooth(board.image(), 1.0), board.corners + 0.7, radii)
    assert proven.all()
    assert np.linalg.norm(points - board.corners, axis=1).max() < 0.05


def test_no_points_give_no_points() -> None:
    points, proven = refine_saddles(surface(20, 20), np.zeros((0, 2)), np.zeros(0, dtype=np.int64))
    assert points.shape == (0, 2)
    assert proven.shape == (0,)


def test_bilinear_samples_of_a_plane_are_the_plane() -> None:
    y, x = np.mgrid[:20, :30].astype(np.float64)
    plane = (2.0 * x - 3.0 * y).astype(np.float32)
    at_x, at_y = np.array([3.25, 28.9]), np.array([7.125, 0.01])
    assert sample_bilinear(plane, at_x, at_y) == pytest.approx(2.0 * at_x - 3.0 * at_y, abs=1e-5)
