"""JSON in its one canonical form (RFC 8785, JCS), so that equal values are equal bytes, and so equal hashes.

Numbers are written as ECMAScript writes a double: the shortest digits that read back as the same double,
without an exponent from 1e-6 up to 1e21, and no −0. Python's `repr` finds the same digits and differs in
their layout only. Names are sorted by their UTF-16 code units.
"""

import json
import math
from collections.abc import Mapping
from decimal import Decimal
from typing import Any

# Beyond it a double skips whole numbers: what is written would not be what was meant.
LARGEST_INTEGER = 2**53


def canonical_json(value: Any) -> bytes:
    """Return the canonical form, UTF-8, of a JSON value.

    Raises ValueError for what it cannot say: NaN, infinities, whole numbers beyond 2^53, lone surrogates, and
    types that JSON has not.
    """
    return _write(value).encode("utf-8")


def canonical_number(number: float) -> str:
    """Return a double as ECMAScript writes it; raises ValueError for NaN and infinities."""
    if not math.isfinite(number):
        raise ValueError(f"JSON has no {number}")
    if number == 0:
        return "0"
    sign, digits, exponent = Decimal(repr(float(number))).normalize().as_tuple()
    text = "".join(map(str, digits))
    # The value is 0.DIGITS times ten to the power of `point`.
    point = len(text) + int(exponent)
    return "-" * sign + _layout(text, point)


def _layout(digits: str, point: int) -> str:
    count = len(digits)
    if count <= point <= 21:
        return digits + "0" * (point - count)
    if 0 < point <= 21:
        return f"{digits[:point]}.{digits[point:]}"
    if -6 < point <= 0:
        return f"0.{'0' * -point}{digits}"
    fraction = f".{digits[1:]}" if count > 1 else ""
    return f"{digits[0]}{fraction}e{point - 1:+d}"


def _write(value: Any) -> str:
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    if isinstance(value, str):
        return json.dumps(str(value), ensure_ascii=False)
    if isinstance(value, int):
        if abs(value) > LARGEST_INTEGER:
            raise ValueError(
                f"{value} is beyond the whole numbers that JSON carries exactly; give it as text"
            )
        return str(int(value))
    if isinstance(value, float):
        return canonical_number(value)
    if isinstance(value, list | tuple):
        return f"[{','.join(map(_write, value))}]"
    if isinstance(value, Mapping):
        return _write_object(value)
    raise ValueError(f"JSON has no {type(value).__name__}")


def _write_object(value: Mapping[Any, Any]) -> str:
    if not all(isinstance(name, str) for name in value):
        raise ValueError("names in JSON are text")
    names = sorted(value, key=lambda name: name.encode("utf-16-be", "surrogatepass"))
    return f"{{{','.join(f'{_write(name)}:{_write(value[name])}' for name in names)}}}"
