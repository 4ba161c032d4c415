"""Results: the stored calibration of a run as it is shown."""

from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.quality.gates import Verdict
from service.storage.models import CalibrationRow, MeasurementRow, RunRow


@dataclass(frozen=True)
class ResultView:
    """A judged calibration."""

    id: UUID
    run_id: UUID
    verdict: Verdict
    lens: str
    image_size: tuple[int, int]
    intrinsics: dict[str, float]
    sd: dict[str, float | None]
    rms_px: float
    sigma_px: float
    mapping: dict[str, float | None]
    score: float | None
    gates: list[MeasurementRow]
    views: list[dict[str, Any]]
    starts: list[dict[str, Any]]
    agreement_px: float | None
    early_finish: dict[str, Any] | None
    extrinsics: dict[str, Any] | None
    board_shape: dict[str, Any] | None
    versions: dict[str, str]
    created_at: datetime


def read_result(session: Session, run_id: UUID) -> ResultView:
    """Return the result of a run; raises NotFound for an unknown run and for one without a result."""
    run = session.get(RunRow, run_id)
    if run is None:
        raise NotFound(
            "There is no run of this id. List the runs of the serial to find it.", run_id=str(run_id)
        )
    result = find_result(session, run_id)
    if result is None:
        raise NotFound(
            f"The run is {run.state} and has no result. Finish it to get one.",
            run=f"/api/v1/runs/{run_id}",
            state=run.state.value,
        )
    return result


def find_result(session: Session, run_id: UUID) -> ResultView | None:
    """Return the result of a run, or None."""
    row = session.scalar(select(CalibrationRow).where(CalibrationRow.run_id == run_id))
    return None if row is None else _view(session, row)


def _view(session: Session, row: CalibrationRow) -> ResultView:
    measurements = session.scalars(
        select(MeasurementRow).where(MeasurementRow.calibration_id == row.id).order_by(MeasurementRow.id)
    )
    document = row.document
    return ResultView(
        id=row.id,
        run_id=row.run_id,
        verdict=row.verdict,
        lens=row.lens,
        image_size=tuple(document["image_size"]),
        intrinsics=row.intrinsics,
        sd=document["sd"],
        rms_px=row.rms_px,
        sigma_px=row.sigma_px,
        mapping=document["mapping"],
        score=document["score"],
        gates=list(measurements),
        views=document["views"],
        starts=document["starts"],
        agreement_px=document["agreement_px"],
        early_finish=document.get("early_finish"),
        extrinsics=document.get("extrinsics"),
        board_shape=document.get("board_shape"),
        versions=row.versions,
        created_at=row.created_at,
    )
