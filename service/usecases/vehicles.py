"""Vehicles: the calibration history of one serial."""

from dataclasses import dataclass

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.run import RunState, check_serial
from service.storage.models import RunRow
from service.usecases.results import ResultView, find_result
from service.usecases.runs import RunView, view_runs

LONGEST_HISTORY = 200


@dataclass(frozen=True)
class VehicleView:
    """The runs of a serial, newest first, and the result of the latest finished one."""

    serial: str
    runs: list[RunView]
    latest_result: ResultView | None


def read_vehicle(session: Session, serial: str) -> VehicleView:
    """Return the history of a serial; raises SerialInvalid, and NotFound for one without any run."""
    serial = check_serial(serial)
    newest_first = (
        select(RunRow).where(RunRow.serial == serial).order_by(RunRow.created_at.desc(), RunRow.id.desc())
    )
    rows = list(session.scalars(newest_first.limit(LONGEST_HISTORY)))
    if not rows:
        raise NotFound(
            f"No run is known for the serial '{serial}'. Serials are compared exactly.", serial=serial
        )
    finished = session.scalar(newest_first.where(RunRow.state == RunState.FINISHED).limit(1))
    latest = None if finished is None else find_result(session, finished.id)
    return VehicleView(serial, view_runs(session, rows), latest)
