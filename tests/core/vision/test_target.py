"""What holds for every kind of target."""

import cv2
import numpy as np
import pytest

from service.core.errors import TargetSpecInvalid
from service.core.vision.feature_grid import extent
from service.core.vision.target import KINDS, Target, parse_target
from tests.core.vision.printed_board import paint_print

SPECS = (
    "chessboard:9x6:25mm",
    "charuco:11x8:25mm:18mm:4x4_250",
    "aprilgrid:6x5:24mm:0.3",
    "circles:4x11:20mm:10mm",
)


@pytest.fixture(params=SPECS, name="target")
def each_target(request: pytest.FixtureRequest) -> Target:
    return parse_target(request.param)


def test_every_kind_has_an_example_here() -> None:
    assert {spec.partition(":")[0] for spec in SPECS} == set(KINDS)


def test_a_target_comes_back_from_its_words(target: Target) -> None:
    assert target.spec in SPECS
    assert parse_target(target.spec) == target
    assert target.spec.startswith(target.kind + ":")


def test_features_run_row_by_row_from_the_origin(target: Target) -> None:
    points = target.object_points
    assert points.shape == (target.rows * target.columns, 3)
    np.testing.assert_array_equal(points[0], 0.0)
    assert np.all(points[:, 2] == 0.0)
    grid = points.reshape(target.rows, target.columns, 3)
    assert np.all(np.diff(grid[..., 0], axis=1) > 0)
    assert np.all(np.diff(grid[..., 1], axis=0) > 0)


def test_the_outer_features_are_in_the_corners_and_the_centre_between_them(target: Target) -> None:
    low, high = extent(target.object_points)
    np.testing.assert_allclose(target.centre[:2], (low + high) / 2)
    outer = target.object_points[list(target.outer_corners), :2] - target.centre[:2]
    np.testing.assert_array_equal(np.sign(outer), [[-1, -1], [1, -1], [1, 1], [-1, 1]])


def test_the_outline_is_just_around_the_print(target: Target) -> None:
    picture, origin, scale = paint_print(target, px_per_m=4000, border_m=0.01)
    dark_y, dark_x = np.nonzero(picture < 128)
    left, top = origin[0] + (dark_x.min() - 0.5) / scale, origin[1] + (dark_y.min() - 0.5) / scale
    right, bottom = origin[0] + (dark_x.max() + 0.5) / scale, origin[1] + (dark_y.max() + 0.5) / scale
    np.testing.assert_allclose([left, top], target.outline[0, :2], atol=1.5 / scale)
    np.testing.assert_allclose([right, bottom], target.outline[2, :2], atol=1.5 / scale)


def test_a_target_turned_by_half_looks_the_same_if_it_is_symmetric(target: Target) -> None:
    picture, _, _ = paint_print(target, px_per_m=2000, border_m=0.01)
    turned = cv2.rotate(picture, cv2.ROTATE_180)
    differs = np.mean(np.abs(picture.astype(float) - turned) > 128)
    assert bool(differs < 0.01) is target.is_symmetric


@pytest.mark.parametrize("spec", ["", "9x6", "triangles:9x6:25mm", "chessboard", "Charuco:11x8"])
def test_words_that_name_no_kind_show_an_example_of_each(spec: str) -> None:
    with pytest.raises(TargetSpecInvalid) as refused:
        parse_target(spec)
    if ":" in spec or not spec.startswith("chess"):
        assert all(kind in refused.value.detail for kind in KINDS)
