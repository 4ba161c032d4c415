"""Rows for tests."""

from typing import Any

from sqlalchemy.orm import Session

from service.storage.models import CaptureRow, RunRow, SkuRevisionRow, SkuRow
from tests.fakes import START


def make_revision(session: Session, code: str = "lens1") -> SkuRevisionRow:
    """Add a SKU with one revision."""
    sku = SkuRow(code=code, name="Lens", created_at=START)
    revision = SkuRevisionRow(sku_id=sku.id, number=1, document={}, created_at=START)
    session.add_all([sku, revision])
    return revision


def make_run(session: Session, **fields: Any) -> RunRow:
    """Add an open run of a new SKU."""
    values: dict[str, Any] = {"serial": "VIN-1", "created_by": "test", "created_at": START} | fields
    if "sku_revision_id" not in values:
        values["sku_revision_id"] = make_revision(session).id
    run = RunRow(**values)
    session.add(run)
    return run


def make_capture(run: RunRow, number: int, sha256: str) -> CaptureRow:
    """Return a capture without anything seen in it."""
    return CaptureRow(
        run_id=run.id,
        number=number,
        file_name=f"{number}.png",
        sha256=sha256,
        media_type="image/png",
        bytes=1,
        image_size=[1280, 800],
        corners=[],
        corner_ids=[],
        sharpness={},
        parity_separation=1.0,
        contrast=100.0,
        created_at=START,
    )
