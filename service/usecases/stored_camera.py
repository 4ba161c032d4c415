"""The calibrated camera of a finished run as the core sees it, with the zones that its SKU asks for.

Not here: the result as it is shown (`results`), the corners it was computed from (`calibration_input`).
"""

from dataclasses import dataclass
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.quality.coverage import default_valid_region, default_working_zone
from service.core.vision.camera import Intrinsics
from service.core.vision.camera_comparison import CalibratedCamera
from service.core.vision.uncertainty import Region
from service.storage.models import CalibrationRow, SkuRevisionRow
from service.usecases.runs import get_run
from service.usecases.sku_document import SkuDocument


@dataclass(frozen=True)
class StoredCamera:
    """A run's camera, the zones of its SKU revision, and what the calibration says of each view."""

    run_id: UUID
    camera: CalibratedCamera
    working_zone: Region
    valid_region: Region
    views: list[dict[str, Any]]

    @property
    def intrinsics(self) -> Intrinsics:
        """The camera's intrinsics."""
        return self.camera.intrinsics


def load_camera(session: Session, run_id: UUID) -> StoredCamera:
    """Return the camera of a run; raises NotFound for an unknown run and for one without a result."""
    run = get_run(session, run_id)
    row = session.scalar(select(CalibrationRow).where(CalibrationRow.run_id == run_id))
    if row is None:
        raise NotFound(
            f"The run is {run.state} and has no result. Finish it to get one.",
            run=f"/api/v1/runs/{run_id}",
            state=run.state.value,
        )
    document = session.get_one(SkuRevisionRow, run.sku_revision_id).document
    revision = SkuDocument.model_validate(document).to_revision()
    width, height = row.document["image_size"]
    size = (int(width), int(height))
    return StoredCamera(
        run_id=run_id,
        camera=CalibratedCamera(
            Intrinsics.from_parameters(row.lens, row.intrinsics, size), np.array(row.covariance)
        ),
        working_zone=revision.working_zone or default_working_zone(size),
        valid_region=revision.valid_region or default_valid_region(size),
        views=row.document["views"],
    )
