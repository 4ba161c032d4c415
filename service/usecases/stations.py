"""Stations: register the calibration places of a line; where their frames come from, what they speak."""

from datetime import datetime
from typing import Literal
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.storage.models import StationRow, TargetRow
from service.storage.words import FrameOrigin, Language
from service.usecases.audit import record
from service.usecases.fixture_document import FixtureDocument
from service.usecases.frame_address import check_source, mask_source
from service.usecases.paging import PageRequest, Part, page_of


def create_station(
    session: Session,
    code: str,
    name: str,
    target_id: UUID | None,
    *,
    source: str = FrameOrigin.BROWSER.value,
    language: Language | None = None,
    fixture: FixtureDocument | None = None,
    files: bool = False,
    who: str,
    now: datetime,
) -> StationRow:
    """Register a station; files: whether `file:` sources are on.

    Raises NotFound for an unknown board, SourceRefused, AlreadyExists for a code that is taken.
    """
    check_source(source, files=files)
    if target_id is not None and session.get(TargetRow, target_id) is None:
        raise NotFound("There is no target of this id. Register the board first.", target_id=str(target_id))
    row = StationRow(
        code=code,
        name=name,
        target_id=target_id,
        source=source,
        language=language,
        fixture=None if fixture is None else fixture.to_json(),
        created_at=now,
    )
    session.add(row)
    session.flush()
    record(session, now, who, "station.create", f"station:{code}", name=name, source=mask_source(source))
    return row


def change_station(
    session: Session,
    code: str,
    *,
    source: str | None = None,
    language: Language | Literal["keep"] | None = "keep",
    fixture: FixtureDocument | Literal["keep"] | None = "keep",
    files: bool,
    who: str,
    now: datetime,
) -> StationRow:
    """Give a station another source (None: keep it) or language, from its next kiosk on, or fixture.

    language: None leaves it to the kiosk's browser. fixture: where its fixed target stands; None: it has
    none. Raises NotFound, SourceRefused.
    """
    row = get_station(session, code)
    if source is not None:
        row.source = check_source(source, files=files)
        record(session, now, who, "station.source", f"station:{code}", source=mask_source(source))
    if language != "keep":
        row.language = language
        record(session, now, who, "station.language", f"station:{code}", language=language)
    if fixture != "keep":
        row.fixture = None if fixture is None else fixture.to_json()
        told = None if fixture is None else fixture.model_dump_json()
        record(session, now, who, "station.fixture", f"station:{code}", fixture=told)
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
