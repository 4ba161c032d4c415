"""The few forms of YAML that exports need, such that readers of YAML 1.1 and 1.2 read the same values."""

import json
from collections.abc import Iterable


def yaml_number(value: float) -> str:
    """Return a number with all its digits; YAML 1.1 takes 1e-05 for text unless there is a point in it."""
    digits, mark, exponent = repr(float(value)).partition("e")
    return f"{digits if '.' in digits else f'{digits}.0'}{mark}{exponent}" if mark else digits


def yaml_numbers(values: Iterable[float]) -> str:
    """Return numbers as a list on one line."""
    return f"[{', '.join(map(yaml_number, values))}]"


def yaml_text(text: str) -> str:
    """Return a text in double quotes."""
    return json.dumps(text, ensure_ascii=False)
