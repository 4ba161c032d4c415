"""Targets: register the physical boards of a plant."""

from datetime import datetime

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.vision.target import parse_target
from service.storage.models import TargetRow
from service.usecases.audit import record
from service.usecases.paging import PageRequest, Part, page_of

DRIFT_LIMIT_MM = 0.1


def create_target(
    session: Session,
    serial: str | None,
    spec: str,
    drift_limit_mm: float = DRIFT_LIMIT_MM,
    *,
    who: str,
    now: datetime,
) -> TargetRow:
    """Register a board; raises TargetSpecInvalid, and AlreadyExists for a serial that is taken."""
    row = TargetRow(
        serial=serial, spec=parse_target(spec).spec, drift_limit_mm=drift_limit_mm, created_at=now
    )
    session.add(row)
    session.flush()
    record(session, now, who, "target.create", f"target:{row.id}", serial=serial, spec=row.spec)
    return row


def list_targets(session: Session, page: PageRequest) -> Part[TargetRow]:
    """Return a part of the boards, newest first."""
    return page_of(session, select(TargetRow), TargetRow, page)
