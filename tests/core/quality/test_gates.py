"""A value against its limit."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.core.quality.gates import (
    Comparison,
    Measurement,
    Verdict,
    check_limit,
    report_value,
    worst_verdict,
)

finite = st.floats(-1e6, 1e6)


def check(value: float, comparison: Comparison, limit: float, share: float = 0.8) -> Measurement:
    return check_limit(
        "fit", "rms_px", value, comparison, limit, share=share, good="Good.", bad="Bad.", remedy="Mend it."
    )


@pytest.mark.parametrize(
    ("value", "comparison", "limit", "verdict"),
    [
        (0.79, "<=", 1.0, Verdict.PASS),
        (0.81, "<=", 1.0, Verdict.MARGINAL),
        (1.0, "<=", 1.0, Verdict.MARGINAL),
        (1.01, "<=", 1.0, Verdict.FAIL),
        (0.0, "<=", 0.0, Verdict.PASS),
        (1.0, "<=", 0.0, Verdict.FAIL),
        (51.0, ">=", 40.0, Verdict.PASS),
        (49.0, ">=", 40.0, Verdict.MARGINAL),
        (39.9, ">=", 40.0, Verdict.FAIL),
        (-0.1, ">=", 0.0, Verdict.FAIL),
        (1.0, "==", 1.0, Verdict.PASS),
        (0.0, "==", 1.0, Verdict.FAIL),
        (math.nan, "<=", 1.0, Verdict.FAIL),
        (math.nan, ">=", 1.0, Verdict.FAIL),
        (math.inf, "<=", 1.0, Verdict.FAIL),
    ],
)
def test_verdict_of_a_value(value: float, comparison: Comparison, limit: float, verdict: Verdict) -> None:
    assert check(value, comparison, limit).verdict is verdict


@given(value=finite, limit=finite, comparison=st.sampled_from(["<=", ">="]))
def test_a_value_fails_exactly_when_its_margin_is_negative(
    value: float, limit: float, comparison: Comparison
) -> None:
    measurement = check(value, comparison, limit)
    assert measurement.margin is not None
    assert (measurement.verdict is Verdict.FAIL) == (measurement.margin < 0)


def test_advice_says_what_it_means_what_to_gain_or_what_to_do() -> None:
    assert check(0.1, "<=", 1.0).advice == "Good."
    assert check(0.9, "<=", 1.0).advice == "Accepted, but with little margin. Mend it."
    assert check(2.0, "<=", 1.0).advice == "Bad. Mend it."


def test_a_value_that_is_not_known_is_null_and_not_a_number_json_lacks() -> None:
    measurement = check(math.nan, "<=", 1.0)
    assert measurement.value is None
    assert measurement.margin is None


def test_a_value_may_be_bad_and_yet_cost_a_clean_pass_only() -> None:
    measurement = check_limit(
        "frame",
        "refused_images",
        3.0,
        "<=",
        0.0,
        good="g",
        bad="Bad.",
        remedy="Mend.",
        worst=Verdict.MARGINAL,
    )
    assert measurement.verdict is Verdict.MARGINAL
    assert measurement.advice == "Bad. Mend."


def test_a_reported_value_has_no_limit_and_passes() -> None:
    measurement = report_value("score", "paper_score", 1e9, advice="a")
    assert (measurement.limit, measurement.margin, measurement.verdict) == (None, None, Verdict.PASS)


def test_the_worst_verdict_decides() -> None:
    assert worst_verdict([]) is Verdict.PASS
    assert worst_verdict([Verdict.PASS, Verdict.MARGINAL, Verdict.PASS]) is Verdict.MARGINAL
    assert worst_verdict([Verdict.FAIL, Verdict.MARGINAL]) is Verdict.FAIL
