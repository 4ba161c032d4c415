"""How the camera of a serial came out in each of its runs: what charts over time need.

Not here: the runs themselves (`vehicles`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.quality.gates import Verdict
from service.core.run import Purpose, check_serial
from service.core.vision.camera import parameter_names
from service.storage.models import CalibrationRow, RunRow, SkuRevisionRow, SkuRow
from service.usecases.observation import number_or_null

LONGEST_HISTORY = 200


@dataclass(frozen=True)
class PastCalibration:
    """What one finished run of the serial came to; `sd` is zero for fixed parameters."""

    run_id: UUID
    created_at: datetime
    sku: str
    purpose: Purpose
    verdict: Verdict
    lens: str
    rms_px: float
    intrinsics: Mapping[str, float]
    sd: Mapping[str, float | None]


@dataclass(frozen=True)
class VehicleHistory:
    """The calibrations of a serial, oldest first, as far back as the latest of them reach."""

    serial: str
    calibrations: list[PastCalibration]


def read_history(session: Session, serial: str) -> VehicleHistory:
    """Return what each finished run of a serial came to; raises SerialInvalid, NotFound."""
    serial = check_serial(serial)
    query = (
        # Without the document, which holds every residual.
        select(
            RunRow.id,
            RunRow.created_at,
            SkuRow.code,
            RunRow.purpose,
            CalibrationRow.verdict,
            CalibrationRow.lens,
            CalibrationRow.rms_px,
            CalibrationRow.intrinsics,
            CalibrationRow.covariance,
        )
        .join(CalibrationRow, CalibrationRow.run_id == RunRow.id)
        .join(SkuRevisionRow, SkuRevisionRow.id == RunRow.sku_revision_id)
        .join(SkuRow, SkuRow.id == SkuRevisionRow.sku_id)
        .where(RunRow.serial == serial)
        .order_by(RunRow.created_at.desc(), RunRow.id.desc())
        .limit(LONGEST_HISTORY)
    )
    found = [PastCalibration(*row[:-1], _sd(row.lens, row.covariance)) for row in session.execute(query)]
    if not found and session.scalar(select(RunRow.id).where(RunRow.serial == serial).limit(1)) is None:
        raise NotFound(
            f"No run is known for the serial '{serial}'. Serials are compared exactly.", serial=serial
        )
    return VehicleHistory(serial, found[::-1])


def _sd(lens: str, covariance: list[list[float]]) -> dict[str, float | None]:
    variances = np.maximum(np.diagonal(np.array(covariance, dtype=np.float64)), 0.0)
    return {
        name: number_or_null(float(value))
        for name, value in zip(parameter_names(lens), np.sqrt(variances), strict=True)
    }
