"""Runs: open one for a serial, read and list them, abort one. Finishing stands in `finish`."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any
from uuid import UUID

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from service.core.errors import NotFound, PoseSetNotPublished
from service.core.run import Outcome, Purpose, RunState, check_open, check_serial
from service.storage.models import (
    CalibrationRow,
    CaptureRow,
    PoseSetRow,
    RunPoseRow,
    RunRow,
    SkuRevisionRow,
    SkuRow,
    StationRow,
)
from service.storage.words import Publication
from service.usecases.audit import record
from service.usecases.capture_views import CaptureView, view_captures
from service.usecases.paging import PageRequest, Part, page_of
from service.usecases.results import ResultView, find_result
from service.usecases.run_filter import RunFilter
from service.usecases.run_poses import read_added
from service.usecases.skus import SkuReference, get_published_revision
from service.usecases.stations import get_station


@dataclass(frozen=True)
class Order:
    """What a run is opened with: SKU code, serial, station code, purpose."""

    sku: str
    serial: str
    station: str | None
    purpose: Purpose


@dataclass(frozen=True)
class RunView:
    """A run as it is shown; captures and result are filled in where one run is read."""

    id: UUID
    serial: str
    sku: SkuReference
    station: str | None
    purpose: Purpose
    state: RunState
    verdict: str | None
    outcome: Outcome | None
    captures: int
    poses: int
    rms_px: float | None
    created_at: datetime
    finished_at: datetime | None
    pose_set_id: UUID | None
    capture_list: Sequence[CaptureView] = field(default=())
    added_poses: Sequence[RunPoseRow] = field(default=())
    result: ResultView | None = None


def open_run(session: Session, order: Order, who: str, now: datetime) -> RunView:
    """Open a run on the SKU's published revision and pose set.

    Raises SerialInvalid, NotFound, RevisionNotPublished, and PoseSetNotPublished where the purpose needs a
    set.
    """
    serial = check_serial(order.serial)
    revision = get_published_revision(session, order.sku)
    pose_set_id = _published_pose_set(session, revision.id)
    if pose_set_id is None and order.purpose.needs_pose_set:
        raise PoseSetNotPublished(
            f"SKU '{order.sku}', revision {revision.number}, has no published pose set, so that poses "
            "could not be "
            f"judged. Plan and publish one, or open the run with another purpose than {order.purpose}.",
            sku=order.sku,
            revision=revision.number,
        )
    station = None if order.station is None else get_station(session, order.station)
    row = RunRow(
        sku_revision_id=revision.id,
        pose_set_id=pose_set_id,
        station_id=None if station is None else station.id,
        target_id=None if station is None else station.target_id,
        serial=serial,
        purpose=order.purpose,
        created_by=who,
        created_at=now,
    )
    session.add(row)
    session.flush()
    record(session, now, who, "run.open", f"run:{row.id}", serial=serial, sku=order.sku)
    return read_run(session, row.id)


def get_run(session: Session, run_id: UUID, *, lock: bool = False) -> RunRow:
    """Return a run, with its row locked for this transaction if asked; raises NotFound."""
    row = session.get(RunRow, run_id, with_for_update=lock)
    if row is None:
        raise NotFound(
            "There is no run of this id. List the runs of the serial to find it.", run_id=str(run_id)
        )
    return row


def read_run(session: Session, run_id: UUID) -> RunView:
    """Return a run with its captures and result; raises NotFound."""
    row = get_run(session, run_id)
    captures = session.scalars(
        select(CaptureRow).where(CaptureRow.run_id == run_id).order_by(CaptureRow.number)
    )
    views = view_captures(captures)
    added, result = read_added(session, run_id), find_result(session, run_id)
    return view_runs(session, [row], captures=views, added=added, result=result)[0]


def list_runs(session: Session, page: PageRequest, wanted: RunFilter) -> Part[RunView]:
    """Return a part of the runs that are wanted, newest first."""
    part = page_of(session, wanted.narrow(select(RunRow)), RunRow, page)
    return Part(view_runs(session, part.items), part.next_cursor)


def abort_run(session: Session, run_id: UUID, who: str, now: datetime) -> RunView:
    """End an open run without a result; raises NotFound, RunAlreadyFinished, RunAborted."""
    row = get_run(session, run_id, lock=True)
    check_open(row.state, str(run_id))
    row.state, row.outcome, row.finished_at = RunState.ABORTED, Outcome.ABORTED, now
    record(session, now, who, "run.abort", f"run:{run_id}", serial=row.serial)
    session.flush()
    return read_run(session, run_id)


def view_runs(session: Session, rows: Sequence[RunRow], **details: Any) -> list[RunView]:
    """Return runs as they are shown, with a fixed number of queries however many they are."""
    ids = [row.id for row in rows]
    skus = _references(session, {row.sku_revision_id for row in rows})
    stations = _column(session, StationRow.id, StationRow.code, {row.station_id for row in rows})
    poses = _column(session, PoseSetRow.id, PoseSetRow.poses, {row.pose_set_id for row in rows})
    rms = _column(session, CalibrationRow.run_id, CalibrationRow.rms_px, ids)
    counts = session.execute(
        select(CaptureRow.run_id, func.count()).where(CaptureRow.run_id.in_(ids)).group_by(CaptureRow.run_id)
    )
    captures: dict[UUID, int] = dict(counts.all())
    return [
        RunView(
            id=row.id,
            serial=row.serial,
            sku=skus[row.sku_revision_id],
            station=stations.get(row.station_id),
            purpose=row.purpose,
            state=row.state,
            verdict=row.verdict,
            outcome=row.outcome,
            captures=captures.get(row.id, 0),
            poses=len(poses.get(row.pose_set_id, ())),
            rms_px=rms.get(row.id),
            created_at=row.created_at,
            finished_at=row.finished_at,
            pose_set_id=row.pose_set_id,
            capture_list=details.get("captures", ()),
            added_poses=details.get("added", ()),
            result=details.get("result"),
        )
        for row in rows
    ]


def _published_pose_set(session: Session, revision_id: UUID) -> UUID | None:
    return session.scalar(
        select(PoseSetRow.id).where(
            PoseSetRow.sku_revision_id == revision_id, PoseSetRow.state == Publication.PUBLISHED
        )
    )


def _references(session: Session, revision_ids: set[UUID]) -> dict[UUID, SkuReference]:
    query = select(SkuRevisionRow.id, SkuRow.code, SkuRevisionRow.number).join(
        SkuRow, SkuRow.id == SkuRevisionRow.sku_id
    )
    found = session.execute(query.where(SkuRevisionRow.id.in_(revision_ids)))
    return {revision_id: SkuReference(code, number) for revision_id, code, number in found}


def _column(session: Session, key: Any, value: Any, wanted: Any) -> dict[Any, Any]:
    keys = [one for one in wanted if one is not None]
    return dict(session.execute(select(key, value).where(key.in_(keys))).all())
