"""Read a SKU document from a file, for the command. Not here: what the document holds (sku_document.py)."""

from pathlib import Path

from service.core.errors import SkuFileUnreadable
from service.usecases.document_file import read_document
from service.usecases.sku_document import Revision, SkuDocument


def read_sku_file(path: Path) -> Revision:
    """Return the revision that a JSON file describes; raises SkuFileUnreadable naming what to correct."""
    return read_document(path, SkuDocument, "SKU document", SkuFileUnreadable).to_revision()
