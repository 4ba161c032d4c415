"""Text that the service accepts: what may be stored, shown and searched.

Not here: meanings of single fields.
"""

import unicodedata
from typing import Annotated

from pydantic import AfterValidator, StringConstraints

CODE_PATTERN = r"^[a-z0-9][a-z0-9._-]{0,63}$"


def check_printable(text: str) -> str:
    """Return the text, or raise ValueError if it holds a control or another unprintable character."""
    for character in text:
        # Databases refuse NUL; the other ones break labels, logs and terminals.
        if unicodedata.category(character) in {"Cc", "Cs", "Co", "Cn"}:
            raise ValueError(f"must not hold the control character U+{ord(character):04X}")
    return text


Label = Annotated[str, StringConstraints(min_length=1, max_length=200), AfterValidator(check_printable)]
Code = Annotated[str, StringConstraints(pattern=CODE_PATTERN)]
