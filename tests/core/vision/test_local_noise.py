import numpy as np
import pytest

from service.core.vision.local_noise import local_sigma, neighbour_correlation, residual_grid
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array

BOARD = Chessboard(9, 6, 0.025)


def places(seed: int) -> Array:
    """Corners of a board in perspective, px: (6, 9, 2)."""
    x, y = np.meshgrid(np.arange(9.0), np.arange(6.0))
    tilt = 1.0 + 0.02 * x + 0.03 * y + 0.001 * seed
    return np.stack([40.0 * x / tilt + 5.0 * y, 38.0 * y / tilt], axis=-1)


def smooth(at: Array) -> Array:
    """Residuals as a bent board leaves them: they change slowly over the board."""
    x, y = at[..., 0] / 300.0, at[..., 1] / 200.0
    return np.stack([0.4 * np.sin(3.0 * x), 0.3 * np.cos(2.0 * y + x)], axis=-1)


def test_noise_is_found_under_any_smooth_error() -> None:
    rng = np.random.default_rng(1)
    grids = [places(i) for i in range(30)]
    noisy = [smooth(at) + rng.normal(0.0, 0.1, at.shape) for at in grids]
    assert local_sigma(noisy, grids) == pytest.approx(0.1, rel=0.06)
    assert local_sigma([smooth(at) for at in grids], grids) < 0.01


def test_neighbours_are_alike_only_where_the_error_is_no_noise() -> None:
    rng = np.random.default_rng(2)
    noise = [rng.normal(0.0, 0.1, (6, 9, 2)) for _ in range(30)]
    bent = [smooth(places(i)) + rng.normal(0.0, 0.1, (6, 9, 2)) for i in range(30)]
    assert abs(neighbour_correlation(noise)) < 0.05
    assert neighbour_correlation(bent) > 0.5


def test_a_board_that_is_seen_in_part_counts_with_what_is_whole() -> None:
    rng = np.random.default_rng(3)
    seen = np.arange(54)[:27]
    values = rng.normal(0.0, 0.1, (27, 2))
    grid = residual_grid(values, seen, BOARD)
    assert np.isnan(grid[3:]).all()
    assert np.isfinite(local_sigma([grid], [residual_grid(places(0).reshape(-1, 2)[seen], seen, BOARD)]))
    assert np.isnan(local_sigma([np.full((6, 9, 2), np.nan)], [places(0)]))
