"""Zones, hulls and shares."""

import numpy as np
import pytest

from service.core.quality.coverage import (
    covered_share,
    default_valid_region,
    default_working_zone,
    seen_grid,
    zone_grid,
)
from service.core.vision.uncertainty import Region

SQUARE = np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0], [50.0, 50.0]])


@pytest.mark.parametrize(
    ("zone", "share"),
    [
        (Region(10, 10, 90, 90), 1.0),
        (Region(0, 0, 200, 100), 0.5),
        (Region(50, 50, 150, 150), 0.25),
        (Region(200, 200, 300, 300), 0.0),
        (Region(-100, -100, 200, 200), 1 / 9),
    ],
)
def test_the_share_of_a_zone_within_the_hull(zone: Region, share: float) -> None:
    assert covered_share(SQUARE, zone) == pytest.approx(share, abs=1e-6)


def test_the_default_zones_are_central() -> None:
    working, valid = default_working_zone((1001, 501)), default_valid_region((1001, 501))
    assert (working.left_px, working.right_px) == pytest.approx((150.0, 850.0))
    assert (valid.top_px, valid.bottom_px) == pytest.approx((25.0, 475.0))


def test_a_zones_grid_reaches_its_corners() -> None:
    grid = zone_grid(Region(1, 2, 3, 4))
    assert grid.min(axis=0) == pytest.approx([1, 2])
    assert grid.max(axis=0) == pytest.approx([3, 4])


def test_what_was_seen_is_within_the_hull_and_reaches_its_corners() -> None:
    triangle = np.array([[0.0, 0.0], [100.0, 0.0], [0.0, 100.0]])
    grid = seen_grid(triangle)
    assert np.all(grid.sum(axis=1) <= 100.0 + 1e-3)
    assert all(np.any(np.all(grid == corner, axis=1)) for corner in triangle)
    assert len(grid) > 150
