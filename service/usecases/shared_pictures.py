"""Pictures of a run that other runs hold too, told by the hash of their content.

Not here: whether that is a fault (the identity gate; simulated runs may replay one picture for every
vehicle).
"""

from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session, aliased

from service.storage.models import CaptureRow, RunRow
from service.usecases.runs import get_run

MOST = 100


@dataclass(frozen=True)
class SharedPicture:
    """A capture of the run, and a capture of another run with the same content."""

    capture_id: UUID
    number: int
    other_run_id: UUID
    other_serial: str
    other_number: int
    other_created_at: datetime


def list_shared(session: Session, run_id: UUID) -> list[SharedPicture]:
    """Return where else the pictures of a run are held, the oldest use first; raises NotFound."""
    get_run(session, run_id)
    other = aliased(CaptureRow)
    query = (
        select(
            CaptureRow.id,
            CaptureRow.number,
            RunRow.id.label("other_run_id"),
            RunRow.serial,
            other.number.label("other_number"),
            other.created_at,
        )
        .join(other, other.sha256 == CaptureRow.sha256)
        .join(RunRow, RunRow.id == other.run_id)
        .where(CaptureRow.run_id == run_id, other.run_id != run_id)
        .order_by(CaptureRow.number, other.created_at, other.id)
        .limit(MOST)
    )
    return [SharedPicture(*row) for row in session.execute(query)]
