"""Extrinsics that were measured after their run, as they are shown. Not here: `later_extrinsics`."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.quality.gates import Verdict
from service.ports import BlobStore
from service.storage.models import RunRow, StationRow
from service.storage.placed import LaterExtrinsicsRow, LaterPictureRow
from service.usecases.capture_views import ShownImage, show_image
from service.usecases.paging import PageRequest, Part, page_of
from service.usecases.runs import get_run

JsonObject = dict[str, Any]


@dataclass(frozen=True)
class LaterPictureView:
    """A picture of the fixed target."""

    id: UUID
    number: int
    file_name: str
    sha256: str
    image_url: str


@dataclass(frozen=True)
class LaterExtrinsicsView:
    """Where the camera of a run is, measured after the run."""

    id: UUID
    run_id: UUID
    serial: str
    station: str
    verdict: Verdict
    extrinsics: JsonObject
    gates: list[JsonObject]
    pictures: list[LaterPictureView]
    versions: JsonObject
    created_at: datetime
    created_by: str


def list_later(session: Session, run_id: UUID, page: PageRequest) -> Part[LaterExtrinsicsView]:
    """Return a part of what was measured after a run, newest first; raises NotFound."""
    query = select(LaterExtrinsicsRow).where(LaterExtrinsicsRow.run_id == get_run(session, run_id).id)
    part = page_of(session, query, LaterExtrinsicsRow, page)
    return Part(view_later(session, part.items), part.next_cursor)


def read_later(session: Session, later_id: UUID) -> LaterExtrinsicsView:
    """Return one measurement; raises NotFound."""
    return view_later(session, [get_later(session, later_id)])[0]


def read_later_image(session: Session, blobs: BlobStore, later_id: UUID, number: int) -> ShownImage:
    """Return one of its pictures; raises NotFound."""
    rows = pictures_of(session, [get_later(session, later_id).id])[later_id]
    for row in rows:
        if row.number == number:
            return show_image(blobs, row.sha256, row.media_type)
    raise NotFound(f"There are {len(rows)} pictures, numbered from 1.", pictures=len(rows))


def get_later(session: Session, later_id: UUID) -> LaterExtrinsicsRow:
    """Return the row of one measurement; raises NotFound."""
    row = session.get(LaterExtrinsicsRow, later_id)
    if row is None:
        raise NotFound("There are no extrinsics of this id. List those of the run.", id=str(later_id))
    return row


def pictures_of(session: Session, later_ids: Iterable[UUID]) -> dict[UUID, list[LaterPictureRow]]:
    """Return the pictures of measurements, in their order."""
    found: dict[UUID, list[LaterPictureRow]] = {one: [] for one in later_ids}
    query = select(LaterPictureRow).where(LaterPictureRow.later_extrinsics_id.in_(found))
    for row in session.scalars(query.order_by(LaterPictureRow.number)):
        found[row.later_extrinsics_id].append(row)
    return found


def view_later(session: Session, rows: Sequence[LaterExtrinsicsRow]) -> list[LaterExtrinsicsView]:
    """Return measurements as they are shown, by a fixed number of queries."""
    pictures = pictures_of(session, [row.id for row in rows])
    runs = select(RunRow).where(RunRow.id.in_({row.run_id for row in rows}))
    stations = select(StationRow).where(StationRow.id.in_({row.station_id for row in rows}))
    serials = {run.id: run.serial for run in session.scalars(runs)}
    codes = {station.id: station.code for station in session.scalars(stations)}
    return [
        LaterExtrinsicsView(
            id=row.id,
            run_id=row.run_id,
            serial=serials[row.run_id],
            station=codes[row.station_id],
            verdict=row.verdict,
            extrinsics=row.document["extrinsics"],
            gates=row.document["gates"],
            pictures=[_picture(one) for one in pictures[row.id]],
            versions=row.versions,
            created_at=row.created_at,
            created_by=row.created_by,
        )
        for row in rows
    ]


def _picture(row: LaterPictureRow) -> LaterPictureView:
    url = f"/api/v1/extrinsics/{row.later_extrinsics_id}/pictures/{row.number}"
    return LaterPictureView(row.id, row.number, row.file_name, row.sha256, url)
