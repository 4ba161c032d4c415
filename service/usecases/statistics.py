"""Figures of the line: first-pass yield, verdicts and failing gates of the last days, what stations do now.

Plain SQL over at most 31 days, the same on SQLite and PostgreSQL. Which runs count stands in `run_filter`.
Not here: control charts, capability and gauge studies.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, date, datetime, timedelta
from typing import Any
from uuid import UUID

from sqlalchemy import Row, case, func, select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.run import RunState
from service.storage.models import (
    CalibrationRow,
    MeasurementRow,
    RunRow,
    SkuRevisionRow,
    SkuRow,
    StationRow,
)
from service.storage.words import Language
from service.usecases.board_shapes import TargetView, view_targets
from service.usecases.paging import PageRequest, Part
from service.usecases.run_filter import RunFilter, is_first_of_serial
from service.usecases.runs import RunView, view_runs
from service.usecases.stations import list_stations

LONGEST_DAYS = 31
PASSED = (Verdict.PASS, Verdict.MARGINAL)


@dataclass(frozen=True)
class YieldCount:
    """Runs that count of one SKU at one station (None: without one) on one day, UTC."""

    sku: str
    station: str | None
    day: date
    passed: int
    marginal: int
    failed: int
    first_runs: int
    first_passed: int


@dataclass(frozen=True)
class FailedGate:
    """A measurement that failed, and in how many of the runs."""

    gate: str
    name: str
    runs: int


@dataclass(frozen=True)
class YieldView:
    """What came out from `since` to `until`, both included; gates with most failed runs first."""

    since: date
    until: date
    counts: list[YieldCount]
    gates: list[FailedGate]


@dataclass(frozen=True)
class StationStanding:
    """A station with its newest open run, its newest finished one, its board and how that has drifted."""

    code: str
    name: str
    source: str  # with what is secret in it
    language: Language | None
    fixture: dict[str, Any] | None
    board: TargetView | None
    open_run: RunView | None
    last_run: RunView | None
    board_drift: dict[str, Any] | None


def read_yield(
    session: Session, now: datetime, days: int, sku: str | None = None, station: str | None = None
) -> YieldView:
    """Return the figures of the last `days` (1 to 31) with today, of one SKU and station if given."""
    until = now.astimezone(UTC).date()
    since = until - timedelta(days=days - 1)
    wanted = RunFilter(sku=sku, station=station, since=since, until=until, counted=True)
    return YieldView(since, until, _counts(session, wanted), _failed_gates(session, wanted))


def list_station_standings(session: Session, page: PageRequest) -> Part[StationStanding]:
    """Return a part of the stations, newest first, with what is done at each."""
    part = list_stations(session, page)
    opened = _newest(session, [row.id for row in part.items], RunState.OPEN)
    finished = _newest(session, [row.id for row in part.items], RunState.FINISHED)
    boards = view_targets(session, {row.target_id for row in part.items if row.target_id is not None})
    standings = [
        _standing(
            row,
            None if row.target_id is None else boards[row.target_id],
            opened.get(row.code),
            finished.get(row.code),
        )
        for row in part.items
    ]
    return Part(standings, part.next_cursor)


def _standing(
    row: StationRow, board: TargetView | None, opened: RunView | None, finished: RunView | None
) -> StationStanding:
    return StationStanding(
        code=row.code,
        name=row.name,
        source=row.source,
        language=row.language,
        fixture=row.fixture,
        board=board,
        open_run=opened,
        last_run=finished,
        board_drift=None if board is None else board.drift,
    )


def _counts(session: Session, wanted: RunFilter) -> list[YieldCount]:
    # One row per run first: PostgreSQL groups by columns, and not by an expression with a subquery in it.
    run = wanted.narrow(
        select(
            RunRow.sku_revision_id,
            RunRow.station_id,
            func.date(RunRow.created_at).label("day"),
            RunRow.verdict,
            case((is_first_of_serial(), 1), else_=0).label("is_first"),
        )
    ).subquery()
    query = (
        select(
            SkuRow.code,
            StationRow.code,
            run.c.day,
            *(func.sum(case((run.c.verdict == verdict, 1), else_=0)) for verdict in Verdict),
            func.sum(run.c.is_first),
            func.sum(case((run.c.verdict.in_(PASSED), run.c.is_first), else_=0)),
        )
        .join(SkuRevisionRow, SkuRevisionRow.id == run.c.sku_revision_id)
        .join(SkuRow, SkuRow.id == SkuRevisionRow.sku_id)
        .outerjoin(StationRow, StationRow.id == run.c.station_id)
        .group_by(SkuRow.code, StationRow.code, run.c.day)
        .order_by(run.c.day, SkuRow.code, StationRow.code)
    )
    return [_count(row) for row in session.execute(query)]


def _count(row: Row[*tuple[Any, ...]]) -> YieldCount:
    sku, station, day, *numbers = row
    # SQLite gives a day as text, PostgreSQL as a date.
    return YieldCount(sku, station, date.fromisoformat(str(day)), *(int(number) for number in numbers))


def _failed_gates(session: Session, wanted: RunFilter) -> list[FailedGate]:
    runs = func.count(RunRow.id.distinct())
    query = replace(wanted, verdict=Verdict.FAIL).narrow(
        select(MeasurementRow.gate, MeasurementRow.name, runs)
        .join(CalibrationRow, CalibrationRow.id == MeasurementRow.calibration_id)
        .join(RunRow, RunRow.id == CalibrationRow.run_id)
        .where(MeasurementRow.verdict == Verdict.FAIL)
    )
    query = query.group_by(MeasurementRow.gate, MeasurementRow.name)
    return [FailedGate(*row) for row in session.execute(query.order_by(runs.desc(), MeasurementRow.name))]


def _newest(session: Session, station_ids: Sequence[UUID], state: RunState) -> dict[str, RunView]:
    """Return the newest run of a state by the code of its station; one step in an index for each."""
    newest = (
        select(RunRow.id)
        .where(RunRow.station_id == StationRow.id, RunRow.state == state)
        .order_by(RunRow.created_at.desc(), RunRow.id.desc())
        .limit(1)
        .correlate(StationRow)
        .scalar_subquery()
    )
    found = session.scalars(select(newest).where(StationRow.id.in_(station_ids))).all()
    views = view_runs(session, session.scalars(select(RunRow).where(RunRow.id.in_(found))).all())
    return {view.station: view for view in views if view.station is not None}
