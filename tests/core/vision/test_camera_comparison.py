"""Two cameras compared, against cameras that differ by what is known, and against drawn estimates."""

import numpy as np
import pytest

from service.core.errors import IntrinsicsInvalid, WrongImageSize
from service.core.vision.camera import Intrinsics, unproject
from service.core.vision.camera_comparison import (
    CalibratedCamera,
    compare_mappings,
    compare_parameters,
    expected_difference,
)
from service.core.vision.image_grid import ImageGrid
from service.core.vision.uncertainty import Region, mapping_difference
from tests.core.planning.cameras import LENS1

ZONE = Region(192.0, 120.0, 1087.0, 679.0)
SD = np.r_[0.3, 0.3, 0.5, 0.4, 1e-3, 8e-3, 1e-4, 1e-4, 2e-2]
COVARIANCE = np.diag(SD**2)
GRID = ImageGrid(LENS1.image_size, columns=16)


def moved(delta: np.ndarray) -> Intrinsics:
    """The camera with its parameters moved."""
    return Intrinsics.from_vector("pinhole5", LENS1.vector + delta, LENS1.image_size)


def test_parameters_are_apart_in_sd_of_both() -> None:
    other = CalibratedCamera(moved(np.r_[3.0, np.zeros(8)]), COVARIANCE)

    found = compare_parameters(CalibratedCamera(LENS1, COVARIANCE), other)

    assert found.difference[0] == pytest.approx(3.0)
    np.testing.assert_allclose(found.sd, np.sqrt(2) * SD)
    assert found.distance_sd == pytest.approx(10 / np.sqrt(2) / 3)


def test_a_fixed_parameter_has_no_sd_and_does_not_count() -> None:
    held = np.diag(np.r_[SD[:-1] ** 2, 0.0])

    found = compare_parameters(CalibratedCamera(LENS1, held), CalibratedCamera(LENS1, held))

    assert found.sd[-1] == 0.0
    assert found.distance_sd == 0.0
    assert np.isnan(compare_parameters(*[CalibratedCamera(LENS1, 0 * held)] * 2).distance_sd)


def test_offsets_are_those_of_the_mapping_difference() -> None:
    other = moved(np.r_[2.0, 1.0, 4.0, -3.0, 0.01, -0.02, 0.0, 0.0, 0.01])
    pixels = ZONE.grid(12, 8)

    found = compare_mappings(LENS1, other, pixels, ZONE)

    np.testing.assert_allclose(
        np.linalg.norm(found.offsets_px, axis=1), mapping_difference(LENS1, other, ZONE), atol=1e-9
    )


def test_a_longer_lens_shows_everything_farther_out() -> None:
    other = moved(np.r_[13.5, 13.5, np.zeros(7)])

    found = compare_mappings(LENS1, other, GRID.centres, ZONE)

    outwards = GRID.centres - LENS1.vector[2:4]
    np.testing.assert_allclose(found.offsets_px, 0.01 * outwards, atol=0.6)
    rays = unproject(LENS1, GRID.centres)
    seen = unproject(LENS1, GRID.centres + found.offsets_px)
    cosine = np.sum(rays * seen, axis=1) / np.linalg.norm(rays, axis=1) / np.linalg.norm(seen, axis=1)
    np.testing.assert_allclose(found.angles_mdeg, 1e3 * np.rad2deg(np.arccos(cosine)), rtol=1e-3, atol=0.1)


def test_a_turned_camera_is_the_same_camera() -> None:
    # A principal point that is a little off is, to first order, a turn.
    found = compare_mappings(LENS1, moved(np.r_[0, 0, 0.5, 0.5, np.zeros(5)]), ZONE.grid(12, 8), ZONE)

    assert np.linalg.norm(found.offsets_px, axis=1).max() < 0.1


def test_two_estimates_of_one_camera_differ_as_much_as_expected() -> None:
    rng = np.random.default_rng(3)
    camera = CalibratedCamera(LENS1, COVARIANCE)
    squares = []
    for _ in range(200):
        a, b = (moved(rng.multivariate_normal(np.zeros(9), COVARIANCE)) for _ in range(2))
        offsets = compare_mappings(a, b, ZONE.grid(6, 4), ZONE).offsets_px
        squares.append(np.mean(np.sum(offsets**2, axis=1)))

    assert np.sqrt(np.mean(squares)) == pytest.approx(
        expected_difference(camera, camera, ZONE.grid(6, 4)), rel=0.15
    )


def test_lens_models_may_differ_for_the_mapping_and_not_for_the_parameters() -> None:
    rational = Intrinsics.from_parameters("rational8", LENS1.parameters, LENS1.image_size)

    found = compare_mappings(LENS1, rational, GRID.centres, ZONE)

    assert np.abs(found.offsets_px).max() < 1e-6
    with pytest.raises(IntrinsicsInvalid, match="pinhole5 and rational8"):
        compare_parameters(
            CalibratedCamera(LENS1, COVARIANCE), CalibratedCamera(rational, np.zeros((12, 12)))
        )


def test_images_of_two_sizes_are_not_compared() -> None:
    other = Intrinsics.from_parameters("pinhole5", LENS1.parameters, (1920, 1208))

    with pytest.raises(WrongImageSize, match="1280x800 and 1920x1208"):
        compare_mappings(LENS1, other, GRID.centres, ZONE)


def test_where_the_other_lens_does_not_reach_there_is_no_offset() -> None:
    folding = Intrinsics.from_vector("pinhole5", np.r_[LENS1.vector[:4], -1.5, np.zeros(4)], LENS1.image_size)

    found = compare_mappings(LENS1, folding, GRID.centres, Region(600, 350, 700, 450))

    nearest = np.argmin(np.linalg.norm(GRID.centres - LENS1.vector[2:4], axis=1))
    assert np.isnan(found.offsets_px[0]).all()
    assert np.isnan(found.angles_mdeg[0])
    assert np.isfinite(found.offsets_px[nearest]).all()
