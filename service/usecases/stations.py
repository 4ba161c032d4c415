"""Stations: register the calibration places of a line."""

from datetime import datetime
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.storage.models import StationRow, TargetRow
from service.storage.words import FrameOrigin
from service.usecases.audit import record
from service.usecases.paging import PageRequest, Part, page_of


def create_station(
    session: Session,
    code: str,
    name: str,
    target_id: UUID | None,
    *,
    source: FrameOrigin = FrameOrigin.BROWSER,
    who: str,
    now: datetime,
) -> StationRow:
    """Register a station; raises NotFound for an unknown board, AlreadyExists for a code that is taken."""
    if target_id is not None and session.get(TargetRow, target_id) is None:
        raise NotFound("There is no target of this id. Register the board first.", target_id=str(target_id))
    row = StationRow(code=code, name=name, target_id=target_id, source=source, created_at=now)
    session.add(row)
    session.flush()
    record(session, now, who, "station.create", f"station:{code}", name=name, source=source.value)
    return row


def get_station(session: Session, code: str) -> StationRow:
    """Return a station by its code; raises NotFound."""
    row = session.scalar(select(StationRow).where(StationRow.code == code))
    if row is None:
        raise NotFound(f"There is no station '{code}'. List the stations, or register it.", station=code)
    return row


def list_stations(session: Session, page: PageRequest) -> Part[StationRow]:
    """Return a part of the stations, newest first."""
    return page_of(session, select(StationRow), StationRow, page)
