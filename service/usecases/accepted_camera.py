"""The camera of a finished run, where its stored result says what the camera still is.

It does when it was accepted and nothing newer is known of the serial. Not here: what is made of it
(`later_extrinsics`).
"""

from dataclasses import dataclass
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.run import Purpose, RunState
from service.core.vision.camera import Intrinsics
from service.core.vision.fixture_problems import ResultNotUsable
from service.core.vision.transforms import Array
from service.storage.models import CalibrationRow, RunRow, SkuRevisionRow
from service.usecases.results import read_result
from service.usecases.runs import get_run
from service.usecases.sku_document import Revision, SkuDocument


@dataclass(frozen=True)
class StoredCamera:
    """Intrinsics as a run found them, their covariance (p, p), and what the run's SKU revision says."""

    run: RunRow
    intrinsics: Intrinsics
    covariance: Array
    revision: Revision


def load_camera(session: Session, run_id: UUID) -> StoredCamera:
    """Return the camera of a finished run; raises NotFound for an unknown run and one without a result."""
    read_result(session, run_id)
    run = get_run(session, run_id)
    row = session.scalars(select(CalibrationRow).where(CalibrationRow.run_id == run_id)).one()
    document = session.get_one(SkuRevisionRow, run.sku_revision_id).document
    revision = SkuDocument.model_validate(document).to_revision()
    return StoredCamera(
        run,
        Intrinsics.from_parameters(row.lens, row.intrinsics, revision.intrinsics.image_size),
        np.array(row.covariance, dtype=np.float64),
        revision,
    )


def check_accepted(session: Session, run: RunRow) -> None:
    """Raise ResultNotUsable unless a run's result is accepted and the newest of its serial and SKU."""
    if run.verdict is Verdict.FAIL:
        raise ResultNotUsable(
            "The run's verdict is FAIL: its intrinsics are not the camera's. Calibrate the camera again and "
            "use that run.",
            run=f"/api/v1/runs/{run.id}",
        )
    newer = _newer(session, run)
    if newer is not None:
        raise ResultNotUsable(
            f"The serial '{run.serial}' was calibrated again since. Use that run: its intrinsics are what "
            "the camera is now.",
            run=f"/api/v1/runs/{newer.id}",
        )


def _newer(session: Session, run: RunRow) -> RunRow | None:
    """Return the newest run of the serial and SKU that finished after a run; simulated ones tell nothing."""
    sku_id = select(SkuRevisionRow.sku_id).where(SkuRevisionRow.id == run.sku_revision_id).scalar_subquery()
    query = (
        select(RunRow)
        .join(SkuRevisionRow, SkuRevisionRow.id == RunRow.sku_revision_id)
        .where(
            RunRow.serial == run.serial,
            RunRow.id != run.id,
            RunRow.state == RunState.FINISHED,
            RunRow.finished_at > run.finished_at,
            SkuRevisionRow.sku_id == sku_id,
        )
        .order_by(RunRow.finished_at.desc())
        .limit(1)
    )
    if run.purpose is not Purpose.SIMULATED:
        query = query.where(RunRow.purpose != Purpose.SIMULATED)
    return session.scalar(query)
