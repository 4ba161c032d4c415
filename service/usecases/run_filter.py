"""Which runs are meant: the conditions that the list of runs and the statistics share.

Because both ask with the same conditions, every number of the statistics leads to a list of that many runs.
Not here: how runs are shown (`runs`) and counted (`statistics`).
"""

from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta
from typing import Any, TypeVarTuple

from sqlalchemy import ColumnElement, Select, and_, exists, or_, select
from sqlalchemy.orm import aliased

from service.core.quality.gates import Verdict
from service.core.run import Purpose, RunState
from service.storage.models import CalibrationRow, MeasurementRow, RunRow, SkuRevisionRow, SkuRow, StationRow

Columns = TypeVarTuple("Columns")

COUNTED_PURPOSES = (Purpose.PRODUCTION, Purpose.RETEST)


@dataclass(frozen=True)
class RunFilter:
    """Conditions that all must hold; None or False leaves one out.

    `since` and `until` are days (UTC) on which a run was opened, both included. `failed` is the name of a
    measurement that failed. `counted`: only what counts for yield, finished runs of production and retest.
    `first`: of those, only the first of each serial and SKU.
    """

    serial: str | None = None
    sku: str | None = None
    station: str | None = None
    without_station: bool = False
    verdict: Verdict | None = None
    failed: str | None = None
    since: date | None = None
    until: date | None = None
    counted: bool = False
    first: bool = False

    def narrow(self, query: Select[*Columns]) -> Select[*Columns]:
        """Return a query on runs that finds only those that meet the conditions."""
        return query.where(*self._equalities(), *self._days(), *self._kinds())

    def _equalities(self) -> list[ColumnElement[bool]]:
        conditions: list[ColumnElement[bool]] = []
        if self.serial is not None:
            conditions.append(RunRow.serial == self.serial)
        if self.sku is not None:
            revisions = select(SkuRevisionRow.id).join(SkuRow, SkuRow.id == SkuRevisionRow.sku_id)
            conditions.append(RunRow.sku_revision_id.in_(revisions.where(SkuRow.code == self.sku)))
        if self.station is not None:
            stations = select(StationRow.id).where(StationRow.code == self.station)
            conditions.append(RunRow.station_id.in_(stations))
        if self.without_station:
            conditions.append(RunRow.station_id.is_(None))
        if self.verdict is not None:
            conditions.append(RunRow.verdict == self.verdict)
        return conditions

    def _days(self) -> list[ColumnElement[bool]]:
        conditions: list[ColumnElement[bool]] = []
        if self.since is not None:
            conditions.append(RunRow.created_at >= start_of(self.since))
        if self.until is not None:
            conditions.append(RunRow.created_at < start_of(self.until + timedelta(days=1)))
        return conditions

    def _kinds(self) -> list[ColumnElement[bool]]:
        conditions: list[ColumnElement[bool]] = []
        if self.failed is not None:
            conditions.append(has_failed(self.failed))
        if self.counted or self.first:
            conditions.append(counts_for_yield(RunRow))
        if self.first:
            conditions.append(is_first_of_serial())
        return conditions


def start_of(day: date) -> datetime:
    """Return the moment at which a day begins, UTC."""
    return datetime.combine(day, time(), UTC)


def counts_for_yield(run: Any) -> ColumnElement[bool]:
    """Return whether a run counts for yield; `run` is RunRow or an alias of it."""
    return and_(run.state == RunState.FINISHED, run.purpose.in_(COUNTED_PURPOSES))


def is_first_of_serial() -> ColumnElement[bool]:
    """Return whether no run that counts was opened before for the same serial and SKU.

    The index on serial and time answers it with the few runs of one serial.
    """
    earlier, revision, own = aliased(RunRow), aliased(SkuRevisionRow), aliased(SkuRevisionRow)
    before = or_(
        earlier.created_at < RunRow.created_at,
        and_(earlier.created_at == RunRow.created_at, earlier.id < RunRow.id),
    )
    return ~exists(
        select(earlier.id)
        .join(revision, revision.id == earlier.sku_revision_id)
        .join(own, own.sku_id == revision.sku_id)
        .where(
            earlier.serial == RunRow.serial,
            own.id == RunRow.sku_revision_id,
            counts_for_yield(earlier),
            before,
        )
        .correlate(RunRow)
    )


def has_failed(measurement: str) -> ColumnElement[bool]:
    """Return whether a run has a measurement of this name that failed."""
    return exists(
        select(MeasurementRow.id)
        .join(CalibrationRow, CalibrationRow.id == MeasurementRow.calibration_id)
        .where(
            CalibrationRow.run_id == RunRow.id,
            MeasurementRow.name == measurement,
            MeasurementRow.verdict == Verdict.FAIL,
        )
        .correlate(RunRow)
    )
