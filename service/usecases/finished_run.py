"""Finished runs as certificates and exports take them: plain values, read from the stored rows.

`RunFacts` is what many runs can be read of at once; `FinishedRun` is everything of one. Not here: how any of
it is written (`certificate`, `exports`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session, defer

from service.core.quality.gates import Verdict
from service.core.run import Purpose
from service.core.vision.camera import Intrinsics, parameter_names
from service.core.vision.transforms import Array
from service.storage.models import (
    CalibrationRow,
    CaptureRow,
    CertificateRow,
    MeasurementRow,
    RunRow,
    SkuRevisionRow,
    SkuRow,
    StationRow,
)
from service.usecases.results import read_result
from service.usecases.runs import get_run
from service.usecases.sku_document import SkuDocument
from service.usecases.vehicle_place import VehiclePlace, find_place

JsonObject = dict[str, Any]


@dataclass(frozen=True)
class RunFacts:
    """Who and what was calibrated, when and where, and what came out.

    covariance: (p, p) in the order of parameter_names(lens). measurements: in the order they were made.
    """

    run_id: UUID
    result_id: UUID
    serial: str
    sku: str
    sku_name: str
    revision: int
    station: str | None
    purpose: Purpose
    opened_at: datetime
    finished_at: datetime
    verdict: Verdict
    intrinsics: Intrinsics
    covariance: Array
    rms_px: float
    sigma_px: float
    measurements: tuple[MeasurementRow, ...]
    versions: dict[str, str]

    @property
    def sd(self) -> dict[str, float]:
        """Standard deviation of each parameter by name; zero where fixed."""
        deviations = np.sqrt(np.maximum(np.diagonal(self.covariance), 0.0))
        return dict(zip(parameter_names(self.intrinsics.lens), map(float, deviations), strict=True))


@dataclass(frozen=True)
class ViewOfRun:
    """One image of a run that the solve used: corners and detected minus projected, (n, 2) px each."""

    number: int
    corners: Array
    residuals: Array


@dataclass(frozen=True)
class ImageOfRun:
    """One image of a run: its number within the run and its content's hash."""

    number: int
    sha256: str


@dataclass(frozen=True)
class FinishedRun:
    """One finished run with all that is stored of it; `document` is the result as it was stored.

    signed_by: the id of the key of its certificate, None before it has one.
    """

    facts: RunFacts
    document: JsonObject
    views: tuple[ViewOfRun, ...]
    images: tuple[ImageOfRun, ...]
    sku: SkuDocument
    signed_by: str | None
    place: VehiclePlace | None


def load_finished_run(session: Session, run_id: UUID) -> FinishedRun:
    """Return a finished run; raises NotFound for an unknown run and for one without a result."""
    read_result(session, run_id)
    run = get_run(session, run_id)
    query = select(CaptureRow).where(CaptureRow.run_id == run_id).order_by(CaptureRow.number)
    captures = list(session.scalars(query))
    document = session.scalars(select(CalibrationRow).where(CalibrationRow.run_id == run_id)).one().document
    return FinishedRun(
        facts=load_facts(session, [run])[0],
        document=document,
        views=_views(captures, document),
        images=tuple(ImageOfRun(capture.number, capture.sha256) for capture in captures),
        sku=SkuDocument.model_validate(session.get_one(SkuRevisionRow, run.sku_revision_id).document),
        signed_by=session.scalar(select(CertificateRow.key_id).where(CertificateRow.run_id == run_id)),
        place=find_place(session, run_id, document),
    )


def load_facts(session: Session, runs: Sequence[RunRow]) -> list[RunFacts]:
    """Return the facts of finished runs in their order, by a fixed number of queries."""
    ids = [run.id for run in runs]
    # The documents of many runs, with a residual for every corner, would fill the memory.
    query = select(CalibrationRow).options(defer(CalibrationRow.document))
    found = session.scalars(query.where(CalibrationRow.run_id.in_(ids)))
    calibrations = {row.run_id: row for row in found}
    measurements = _measurements(session, [row.id for row in calibrations.values()])
    revisions = _revisions(session, {run.sku_revision_id for run in runs})
    stations = {row.id: row.code for row in session.execute(select(StationRow.id, StationRow.code))}
    return [
        _facts(
            run,
            calibrations[run.id],
            measurements[calibrations[run.id].id],
            sku=revisions[run.sku_revision_id],
            station=None if run.station_id is None else stations[run.station_id],
        )
        for run in runs
    ]


@dataclass(frozen=True)
class _Sku:
    code: str
    name: str
    revision: int
    image_size: tuple[int, int]


def _facts(
    run: RunRow,
    calibration: CalibrationRow,
    measurements: Sequence[MeasurementRow],
    *,
    sku: _Sku,
    station: str | None,
) -> RunFacts:
    return RunFacts(
        run_id=run.id,
        result_id=calibration.id,
        serial=run.serial,
        sku=sku.code,
        sku_name=sku.name,
        revision=sku.revision,
        station=station,
        purpose=run.purpose,
        opened_at=run.created_at,
        finished_at=calibration.created_at,
        verdict=calibration.verdict,
        intrinsics=Intrinsics.from_parameters(calibration.lens, calibration.intrinsics, sku.image_size),
        covariance=np.array(calibration.covariance, dtype=np.float64),
        rms_px=calibration.rms_px,
        sigma_px=calibration.sigma_px,
        measurements=tuple(measurements),
        versions=dict(calibration.versions),
    )


def _measurements(session: Session, calibration_ids: Sequence[UUID]) -> dict[UUID, list[MeasurementRow]]:
    query = select(MeasurementRow).where(MeasurementRow.calibration_id.in_(calibration_ids))
    found: dict[UUID, list[MeasurementRow]] = {one: [] for one in calibration_ids}
    for row in session.scalars(query.order_by(MeasurementRow.id)):
        found[row.calibration_id].append(row)
    return found


def _revisions(session: Session, revision_ids: set[UUID]) -> dict[UUID, _Sku]:
    query = (
        select(SkuRevisionRow, SkuRow)
        .join(SkuRow, SkuRow.id == SkuRevisionRow.sku_id)
        .where(SkuRevisionRow.id.in_(revision_ids))
    )
    return {
        revision.id: _Sku(sku.code, sku.name, revision.number, tuple(revision.document["image_size"]))
        for revision, sku in session.execute(query)
    }


def _views(captures: Sequence[CaptureRow], document: JsonObject) -> tuple[ViewOfRun, ...]:
    residuals = {view["capture_id"]: view["residuals"] for view in document["views"]}
    return tuple(
        ViewOfRun(
            capture.number,
            np.array(capture.corners, dtype=np.float64).reshape(-1, 2),
            np.array(residuals[str(capture.id)], dtype=np.float64).reshape(-1, 2),
        )
        for capture in captures
        if str(capture.id) in residuals
    )
