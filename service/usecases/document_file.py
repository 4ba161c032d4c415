"""Read a JSON document from a file, for the command. Not here: what the documents hold (*_document.py)."""

from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from service.core.errors import Unprocessable
from service.usecases.sku_document import Document

Read = TypeVar("Read", bound=Document)
LARGEST_BYTES = 1024 * 1024
PROBLEMS_SHOWN = 5


def read_document(path: Path, kind: type[Read], what: str, error: type[Unprocessable]) -> Read:
    """Return the document that a JSON file holds; raises the error, naming what to correct.

    what: how messages call such a document, such as `SKU document`.
    """
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_BYTES + 1)
    except OSError as problem:
        raise error(f"'{path}' cannot be read: {problem.strerror}.", file=str(path)) from problem
    if len(data) > LARGEST_BYTES:
        raise error(f"'{path}' is too large for a {what}.", file=str(path))
    try:
        return kind.model_validate_json(data)
    except ValidationError as problem:
        found = "; ".join(
            f"{'.'.join(map(str, one['loc'])) or 'the file'}: {one['msg']}"
            for one in problem.errors()[:PROBLEMS_SHOWN]
        )
        raise error(f"'{path}' is no {what}. Correct {found}.", file=str(path)) from problem
