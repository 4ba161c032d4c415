"""How numbers, limits and names are written in the report."""

import math

from service.storage.models import MeasurementRow

LIMITS = {"<=": "max", ">=": "min", "==": "is"}


def number(value: float | None, digits: int = 4) -> str:
    """Return a number with so many significant digits, or a dash where there is none."""
    return "-" if value is None else f"{value:.{digits}g}"


def with_sd(value: float, sd: float) -> tuple[str, str]:
    """Return a value and its sd, both to the second significant digit of the sd."""
    if not math.isfinite(sd) or sd <= 0.0:
        return f"{value:.6g}", "fixed"
    places = max(0, 1 - math.floor(math.log10(sd)))
    return f"{value:.{places}f}", f"{sd:.{places}f}"


def limit(row: MeasurementRow) -> str:
    """Return the limit of a measurement in words."""
    return "-" if row.limit is None else f"{LIMITS[row.comparison]} {number(row.limit)}"


def name(row: MeasurementRow) -> str:
    """Return the name of a measurement as words; its unit stands beside the value."""
    words = row.name.removesuffix(f"_{row.unit}").replace("_", " ")
    return words[:1].upper() + words[1:]


def used_share(row: MeasurementRow) -> float | None:
    """Return which share of its limit a value uses: 1 is at the limit, more beyond; None without a share."""
    if row.limit is None or row.value is None or row.comparison == "==":
        return None
    part, whole = (row.value, row.limit) if row.comparison == "<=" else (row.limit, row.value)
    return None if whole <= 0 or part < 0 else part / whole
