"""Each lens model by itself: derivatives, inverse and reach, for coefficients that nobody chose."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.core.vision.camera import LENSES
from service.core.vision.transforms import Array

# Half widths of the coefficients, in each lens's order.
SPREAD = {
    "pinhole5": (0.4, 0.2, 2e-3, 2e-3, 0.05),
    "rational8": (0.5, 0.2, 2e-3, 2e-3, 0.05, 0.5, 0.2, 0.05),
    "kannala_brandt4": (0.1, 0.05, 0.02, 0.01),
}


@st.composite
def coefficients(draw: st.DrawFn, name: str) -> Array:
    return np.array([draw(st.floats(-half, half)) for half in SPREAD[name]])


def direction(name: str, k: Array, share: float, around: float) -> Array:
    """Return a direction at a share of the lens's reach, or of 75 and 179 degrees where that is farther."""
    perspective = np.isinf(LENSES[name].radius(np.array([0.0, 0.0, -1.0])))
    reach = min(LENSES[name].reach(k), np.tan(np.radians(75.0)) if perspective else np.radians(179.0))
    angle = np.arctan(share * reach) if perspective else share * reach
    return np.array([np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around), np.cos(angle)])


def test_every_lens_is_tried() -> None:
    assert set(SPREAD) == set(LENSES)
    assert all(len(SPREAD[name]) == len(lens.coefficients) for name, lens in LENSES.items())


@pytest.mark.parametrize("name", LENSES)
@settings(max_examples=40, deadline=None)
@given(data=st.data(), share=st.floats(0.0, 0.9), around=st.floats(0.0, 6.28), length=st.floats(0.1, 3.0))
def test_the_derivatives_are_the_finite_differences(
    name: str, data: st.DataObject, share: float, around: float, length: float
) -> None:
    lens, k = LENSES[name], data.draw(coefficients(name))
    point = length * direction(name, k, share, around)
    image, by_point, by_k = lens.project_with_jacobians(point, k)
    np.testing.assert_allclose(image, lens.project(point, k), atol=1e-12)
    step = 1e-6
    for i, delta in enumerate(step * length * np.eye(3)):
        slope = (lens.project(point + delta, k) - lens.project(point - delta, k)) / (2 * step * length)
        np.testing.assert_allclose(by_point[:, i], slope, rtol=1e-5, atol=1e-5 / length)
    for i, delta in enumerate(step * np.eye(len(k))):
        slope = (lens.project(point, k + delta) - lens.project(point, k - delta)) / (2 * step)
        np.testing.assert_allclose(by_k[:, i], slope, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("name", LENSES)
@settings(max_examples=60, deadline=None)
@given(data=st.data(), share=st.floats(0.0, 0.9), around=st.floats(0.0, 6.28))
def test_a_direction_within_reach_comes_back_from_its_image(
    name: str, data: st.DataObject, share: float, around: float
) -> None:
    lens, k = LENSES[name], data.draw(coefficients(name))
    wanted = direction(name, k, share, around)
    found = lens.unproject(lens.project(wanted, k), k)
    np.testing.assert_allclose(found / np.linalg.norm(found), wanted, atol=1e-6)


@pytest.mark.parametrize("name", LENSES)
@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_the_image_radius_grows_up_to_the_reach_and_not_beyond(name: str, data: st.DataObject) -> None:
    lens, k = LENSES[name], data.draw(coefficients(name))
    k[[i for i, coefficient in enumerate(lens.coefficients) if coefficient.startswith("p")]] = 0.0
    shares = np.linspace(0.0, 0.999, 300)
    image = lens.project(np.stack([direction(name, k, share, 0.0) for share in shares]), k)[:, 0]
    assert np.all(np.diff(image) > 0)
    reach = lens.reach(k)
    if reach < 1.3:
        point = (
            np.array([np.tan(reach), 0.0, 1.0]) if name == "kannala_brandt4" else np.array([reach, 0, 1.0])
        )
        # Just before the end, for at a pole itself the quotient has no value.
        point[0] *= 1.0 - 1e-9
        _, by_point, _ = lens.project_with_jacobians(point, k)
        # Across the direction; a pole of the rational model has a slope without bound instead.
        slope = abs(by_point[0] @ np.array([point[2], 0.0, -point[0]]))
        assert slope < 1e-4 or (name == "rational8" and slope > 1e6)


@pytest.mark.parametrize("name", LENSES)
def test_without_coefficients_a_lens_reaches_as_far_as_its_kind_can(name: str) -> None:
    lens = LENSES[name]
    nothing = np.zeros(len(lens.coefficients))
    assert lens.reach(nothing) == (np.pi if name == "kannala_brandt4" else np.inf)
    axis = np.array([0.0, 0.0, 2.0])
    image, by_point, _ = lens.project_with_jacobians(axis, nothing)
    np.testing.assert_allclose(image, [0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(by_point, [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0]], atol=1e-15)
    assert list(lens.sweep_hfov_deg) == sorted(lens.sweep_hfov_deg)


def test_what_is_straight_behind_a_fisheye_has_no_image() -> None:
    image = LENSES["kannala_brandt4"].project(np.array([0.0, 0.0, -1.0]), np.zeros(4))
    assert np.all(np.isnan(image))


def test_newton_that_leaps_about_is_helped() -> None:
    lens, k = LENSES["rational8"], np.array([0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.125, 0.0])
    for share in (0.5, 0.75, 0.9):
        wanted = direction("rational8", k, share, 0.0)
        found = lens.unproject(lens.project(wanted, k), k)
        np.testing.assert_allclose(found / np.linalg.norm(found), wanted, atol=1e-6)


@pytest.mark.parametrize("name", ["pinhole5", "rational8"])
@pytest.mark.parametrize("tangential", [1e-4, 1e-3, 1e-2])
def test_what_is_just_before_the_fold_is_not_taken_for_beyond_it(name: str, tangential: float) -> None:
    lens, rng = LENSES[name], np.random.default_rng(3)
    k = np.array([-0.3, 0.1, 0.0, 0.0, -0.02, 0.1, 0.0, 0.0])[: len(lens.coefficients)]
    k[2:4] = tangential * rng.standard_normal(2)
    reach = lens.reach(k)
    around = rng.uniform(0.0, 2.0 * np.pi, 500)
    ideal = reach * rng.uniform(0.9, 0.999, (500, 1)) * np.stack([np.cos(around), np.sin(around)], axis=-1)
    wanted = np.concatenate([ideal, np.ones((500, 1))], axis=-1)
    image = lens.project(wanted, k)
    found = lens.unproject(image, k)
    # With a tangential part the lens folds a little before its radial part alone does.
    assert np.isfinite(found).all(axis=-1).mean() > 0.9
    again = np.isfinite(found[:, 0])
    np.testing.assert_allclose(lens.project(found[again], k), image[again], atol=1e-8)
    assert np.isnan(lens.unproject(1.2 * image, k)).all()


def test_a_rational_lens_bends_like_the_division_model_where_that_bends_as_wide_lenses_do() -> None:
    lens = LENSES["rational8"]
    distorted = np.linspace(0.0, 0.95, 50)  # to 52 degrees
    ideal = distorted / (1.0 - 0.3 * distorted**2)
    image = lens.project(np.stack([ideal, np.zeros(50), np.ones(50)], axis=-1), lens.like_division(-0.3))
    np.testing.assert_allclose(image[:, 0], distorted, atol=0.03)
    assert not np.any(lens.like_division(0.3))
