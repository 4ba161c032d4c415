"""Read a SKU document from a file, for the command. Not here: what the document holds (sku_document.py)."""

from pathlib import Path

from pydantic import ValidationError

from service.core.errors import SkuFileUnreadable
from service.usecases.sku_document import Revision, SkuDocument

LARGEST_BYTES = 1024 * 1024
PROBLEMS_SHOWN = 5


def read_sku_file(path: Path) -> Revision:
    """Return the revision that a JSON file describes; raises SkuFileUnreadable naming what to correct."""
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_BYTES + 1)
    except OSError as error:
        raise SkuFileUnreadable(f"'{path}' cannot be read: {error.strerror}.", file=str(path)) from error
    if len(data) > LARGEST_BYTES:
        raise SkuFileUnreadable(f"'{path}' is too large for a SKU document.", file=str(path))
    try:
        return SkuDocument.model_validate_json(data).to_revision()
    except ValidationError as error:
        problems = "; ".join(
            f"{'.'.join(map(str, one['loc'])) or 'the file'}: {one['msg']}"
            for one in error.errors()[:PROBLEMS_SHOWN]
        )
        raise SkuFileUnreadable(
            f"'{path}' is no SKU document. Correct {problems}.", file=str(path)
        ) from error
