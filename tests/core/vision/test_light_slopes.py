import numpy as np
import pytest

from service.core.vision.light_slopes import light_slopes

SIGNS = np.where(np.add.outer(np.arange(6), np.arange(9)).ravel() % 2, -1.0, 1.0)
GRID = np.stack(np.meshgrid(np.arange(9) * 40.0, np.arange(6) * 40.0), axis=-1).reshape(-1, 2) + 300.0


def test_slopes_of_a_smooth_fall_of_light_are_found_to_the_border() -> None:
    x, y = GRID.T
    fall = np.exp(-((x - 350) ** 2 + (y - 420) ** 2) / 4e5)
    slopes = light_slopes(GRID, fall[:, None], SIGNS)
    assert slopes[:, 0, 0] == pytest.approx(-2.0 * (x - 350) / 4e5 * fall, abs=3e-5)
    assert slopes[:, 1, 0] == pytest.approx(-2.0 * (y - 420) / 4e5 * fall, abs=3e-5)
    assert np.abs(slopes).max() > 5e-4


def test_noise_of_single_levels_makes_little_slope() -> None:
    noise = np.random.default_rng(1).normal(0.0, 1e-3, (54, 1))
    assert np.sqrt(np.mean(light_slopes(GRID, noise, SIGNS) ** 2)) < 2e-5


@pytest.mark.parametrize(("features", "order"), [(8, 0), (9, 1), (17, 1), (18, 2), (30, 3), (45, 4), (54, 4)])
def test_few_features_are_followed_by_low_orders(features: int, order: int) -> None:
    points = np.random.default_rng(2).uniform(0.0, 100.0, (features, 2))
    x, signs = points[:, 0], np.where(np.arange(features) % 2, -1.0, 1.0)
    for power in range(1, 6):
        slopes = light_slopes(points, (0.01 * x[:, None]) ** power, signs)[:, 0, 0]
        exact = np.allclose(slopes, 0.01 * power * (0.01 * x) ** (power - 1), atol=1e-9)
        assert exact == (power <= order)


def test_what_changes_its_sign_with_the_features_is_no_light() -> None:
    x, y = (GRID - 300.0).T
    error = SIGNS * (0.08 + 1e-4 * x - 2e-4 * y)
    assert light_slopes(GRID, error[:, None], SIGNS) == pytest.approx(0.0, abs=1e-9)


def test_every_column_of_levels_has_its_slopes() -> None:
    slopes = light_slopes(GRID, np.stack([GRID[:, 0], 2.0 * GRID[:, 1]], axis=1), SIGNS)
    assert slopes == pytest.approx(np.broadcast_to([[1.0, 0.0], [0.0, 2.0]], (54, 2, 2)), abs=1e-9)


def test_no_features_have_no_slopes() -> None:
    assert light_slopes(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0)).shape == (0, 2, 2)
