"""Populations: kept unit by unit, and what a camera's distance from one says."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from service.core.quality.evidence import Expectation
from service.core.quality.gates import Verdict
from service.core.quality.population import (
    Moments,
    Population,
    distance_limit,
    expected_advantage,
    population_distance,
    population_of,
    select_units,
)
from service.core.quality.reasons import Reason
from service.core.quality.verdict import Judged
from service.core.vision.camera import Intrinsics
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array
from tests.core.quality.seen_views import NOMINAL, POSES, judge, measured, see_poses

LIMIT = 27.9
NEAR = Intrinsics.from_vector(
    "pinhole5", NOMINAL.vector * np.r_[1.015, 1.015, np.ones(7)], NOMINAL.image_size
)
LESS = Tolerance(focal_share=0.003)


@cache
def noise() -> Array:
    """The covariance of one calibration."""
    return judge(see_poses(noise_px=0.05)).result.covariance


def draw_units(count: int, nominal: Intrinsics = NOMINAL, seed: int = 1) -> list[Array]:
    """Return what calibrations of cameras of a SKU find, noise included."""
    rng = np.random.default_rng(seed)
    lower = np.linalg.cholesky(noise())
    return [draw_camera(nominal, LESS, rng).vector + lower @ rng.standard_normal(9) for _ in range(count)]


def moments_of(units: Sequence[Array]) -> Moments:
    moments = Moments.of_none(9)
    for unit in units:
        moments = moments.with_unit(unit, noise())
    return moments


def population(nominal: Intrinsics = NOMINAL, count: int = 60, seed: int = 1) -> Population:
    return population_of(moments_of(draw_units(count, nominal, seed)))


def judge_camera(camera: Intrinsics, **told: object) -> Judged:
    expectation = Expectation(NOMINAL, poses=POSES, population_units=60)
    return judge(see_poses(camera=camera, noise_px=0.05), replace(expectation, **told))  # type: ignore[arg-type]


def test_moments_are_those_of_the_units_and_forget_one_that_leaves() -> None:
    units = draw_units(30)
    moments = moments_of(units)
    assert np.allclose(moments.mean, np.mean(units, axis=0), rtol=1e-12)
    assert np.allclose(moments.scatter / 29, np.cov(np.array(units).T), rtol=1e-9, atol=1e-18)

    fewer = moments.without_unit(units[3], noise())
    others = moments_of(units[:3] + units[4:])
    assert fewer.units == 29
    assert np.allclose(fewer.mean, others.mean, rtol=1e-12)
    assert np.allclose(fewer.scatter, others.scatter, rtol=1e-7, atol=1e-15)
    assert np.allclose(fewer.own, others.own, rtol=1e-9)


def test_the_noise_of_calibrations_is_no_spread_between_cameras() -> None:
    rng = np.random.default_rng(5)
    same = [NOMINAL.vector + np.linalg.cholesky(noise()) @ rng.standard_normal(9) for _ in range(200)]
    found = population_of(moments_of(same))
    assert np.all(np.diagonal(found.between) < 0.4 * np.diagonal(noise()))
    assert np.linalg.eigvalsh(found.between / np.outer(*[np.sqrt(np.diagonal(noise()))] * 2)).min() > -1e-9


@pytest.mark.parametrize("count", [50, 400])
def test_one_good_camera_of_a_thousand_is_beyond_the_limit_however_many_are_known(count: int) -> None:
    rng = np.random.default_rng(count)
    beyond, trials = 0, 0
    for _ in range(12):
        known = moments_of(
            list(NOMINAL.vector + rng.standard_normal((count, 9)) * np.sqrt(50 * np.diagonal(noise())))
        )
        found = population_of(known)
        for unit in NOMINAL.vector + rng.standard_normal((250, 9)) * np.sqrt(50 * np.diagonal(noise())):
            beyond += population_distance(found, unit, noise()).squared > LIMIT
            trials += 1
    assert beyond / trials < 0.004


def test_fixed_parameters_are_not_counted_and_the_limit_follows() -> None:
    covariance = noise().copy()
    covariance[6:8] = covariance[:, 6:8] = 0.0
    found = population_distance(population(), NOMINAL.vector, covariance)
    assert found.dof == 7
    assert distance_limit(LIMIT, 9) == LIMIT
    assert 24.0 < distance_limit(LIMIT, 7) < 24.6  # the chi-square's 99.9 % for seven


def test_a_stray_among_the_first_units_is_left_out_and_a_mixture_is_not_touched() -> None:
    units = draw_units(50)
    units[17] = units[17] + np.r_[0, 0, 20.0, 0, 0, 0, 0, 0, 0]
    kept = select_units(units, [noise()] * 50, LIMIT)
    assert np.flatnonzero(~kept).tolist() == [17]
    mixed = [
        *draw_units(43),
        *(unit + np.r_[0, 0, 40.0 + i, 0, 0, 0, 0, 0, 0] for i, unit in enumerate(draw_units(7, seed=2))),
    ]
    assert select_units(mixed, [noise()] * 50, LIMIT).all()


def test_until_fifty_units_the_start_limits_hold_and_it_is_said_so() -> None:
    judged = judge_camera(draw_camera(NOMINAL, LESS, np.random.default_rng(9)), population_units=12)
    found = measured(judged, "population_units")
    assert (found.value, found.limit, found.verdict) == (12.0, None, Verdict.PASS)
    assert (found.reason, dict(found.facts)) == (Reason.POPULATION_UNITS, {"count": 12, "of": 50})
    assert "12 of 50" in found.advice
    assert "population_distance" not in {one.name for one in judged.measurements}
    nobody_counts = judge_camera(NOMINAL, population_units=None)
    assert "population_units" not in {one.name for one in nobody_counts.measurements}


def test_a_camera_of_another_sku_fails_though_the_start_limits_let_it_through() -> None:
    told = {"population": population(), "other_populations": {"near": population(NEAR)}}
    stranger = judge_camera(draw_camera(NEAR, LESS, np.random.default_rng(3)), **told)
    assert measured(stranger, "focal_off_share").verdict is not Verdict.FAIL
    assert measured(stranger, "population_distance").verdict is Verdict.FAIL
    assert measured(stranger, "population_distance").facts["parameter"] in {"fx", "fy"}
    assert measured(stranger, "other_population").verdict is Verdict.FAIL
    assert "'near'" in measured(stranger, "other_population").advice

    for seed in range(5):
        good = judge_camera(draw_camera(NOMINAL, LESS, np.random.default_rng(seed)), **told)
        assert measured(good, "population_distance").verdict is Verdict.PASS
        assert measured(good, "other_population").verdict is Verdict.PASS


def test_twins_are_said_to_be_twins() -> None:
    twin = population(seed=7)
    assert expected_advantage(population(), twin, noise()) < 10.0
    assert expected_advantage(population(), population(NEAR), noise()) > 30.0
    for seed in range(5):
        camera = draw_camera(NOMINAL, LESS, np.random.default_rng(seed))
        judged = judge_camera(camera, population=population(), other_populations={"twin": twin})
        found = measured(judged, "other_population")
        assert (found.verdict, found.reason) == (Verdict.PASS, Reason.OTHER_POPULATION_TWIN)
        assert "no picture tells them apart" in found.advice
