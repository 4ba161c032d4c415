"""What a gate says: a measurement with its limit, margin, verdict and advice, and how verdicts combine.

The families of gates are in gates_*.py, the limits' numbers in limits.py.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from service.core.quality.limits import Limits
from service.core.quality.reasons import Facts, Reason

__all__ = [
    "OTHER_LENS",
    "Comparison",
    "Limits",
    "Measurement",
    "Verdict",
    "check_limit",
    "report_value",
    "worst_verdict",
]

Comparison = Literal["<=", ">=", "=="]

OTHER_LENS = "Choose another lens model: rational8 for a wide lens, kannala_brandt4 for a fisheye."


class Verdict(StrEnum):
    """What is said about a measurement or a whole calibration, best first."""

    PASS = "PASS"  # noqa: S105  (a verdict, no password)
    MARGINAL = "MARGINAL"
    FAIL = "FAIL"


SEVERITY = (Verdict.PASS, Verdict.MARGINAL, Verdict.FAIL)


@dataclass(frozen=True)
class Measurement:
    """One value against one limit.

    value: in `unit`, None when it could not be determined. limit: None when the value is only reported.
    margin: distance to the limit in `unit`, positive on the good side; None without value or limit.
    advice: what to do, or for PASS what it means, in English. reason, facts: the same for other languages.
    """

    gate: str
    name: str
    value: float | None
    unit: str
    limit: float | None
    comparison: Comparison
    margin: float | None
    verdict: Verdict
    advice: str
    reason: Reason
    facts: Facts


def check_limit(
    gate: str,
    name: str,
    value: float,
    comparison: Comparison,
    limit: float | Limits,
    *,
    good: str,
    bad: str,
    remedy: str,
    unit: str = "",
    share: float = 1.0,
    worst: Verdict = Verdict.FAIL,
    reason: Reason | None = None,
    facts: Facts | None = None,
) -> Measurement:
    """Return the measurement of a value against its limit; it must be `comparison` the limit.

    limit: a number with its share, or the limits that hold both by the measurement's name. good: what PASS
    means. bad, remedy: what is wrong, and what to do; near the limit there is the remedy only. share:
    MARGINAL from this share of the limit on. worst: the worst verdict this value may lead to. reason: the
    code of these sentences, by default the measurement's name. facts: what they name.
    """
    if isinstance(limit, Limits):
        share, limit = limit.share(name), limit.bound(name)
    verdict = _judge(value, comparison, limit, share)
    if SEVERITY.index(verdict) > SEVERITY.index(worst):
        verdict = worst
    known = math.isfinite(value)
    advice = good if verdict is Verdict.PASS else f"{bad} {remedy}"
    if verdict is Verdict.MARGINAL and worst is Verdict.FAIL:
        advice = f"Accepted, but with little margin. {remedy}"
    return Measurement(
        gate,
        name,
        float(value) if known else None,
        unit,
        float(limit),
        comparison,
        _margin(value, comparison, limit) if known else None,
        verdict,
        advice,
        reason or Reason(name),
        facts or {},
    )


def report_value(
    gate: str, name: str, value: float, *, advice: str, unit: str = "", facts: Facts | None = None
) -> Measurement:
    """Return a measurement that has no limit and never fails."""
    known = float(value) if math.isfinite(value) else None
    return Measurement(
        gate, name, known, unit, None, "<=", None, Verdict.PASS, advice, Reason(name), facts or {}
    )


def worst_verdict(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the worst of some verdicts; PASS for none."""
    return max(verdicts, key=SEVERITY.index, default=Verdict.PASS)


def _judge(value: float, comparison: Comparison, limit: float, share: float) -> Verdict:
    if math.isnan(value):
        return Verdict.FAIL
    if comparison == "==":
        return Verdict.PASS if value == limit else Verdict.FAIL
    used, whole = (value, limit) if comparison == "<=" else (limit, value)
    if used > whole:
        return Verdict.FAIL
    return Verdict.MARGINAL if used > share * whole else Verdict.PASS


def _margin(value: float, comparison: Comparison, limit: float) -> float:
    if comparison == "==":
        return -abs(value - limit)
    return float(limit - value) if comparison == "<=" else float(value - limit)
