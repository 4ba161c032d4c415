"""The errors of a result over the image: what its covariance promises, and what its corners left over.

Computed from what is stored, when it is asked for. Not here: two results (`run_comparison`).
"""

from dataclasses import dataclass
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.vision.error_maps import ResidualMap, measure_residuals, predict_map
from service.core.vision.image_grid import ImageGrid
from service.storage.models import CaptureRow
from service.usecases.image_zones import Rectangle, Rows, rectangle_of, rows_of
from service.usecases.stored_camera import StoredCamera, load_camera

RESIDUAL_COLUMNS = 16  # wide enough cells that a dozen views put several corners into most


@dataclass(frozen=True)
class ResultMaps:
    """Values by cell of the image, row by row; None where the lens does not reach, or no corner was seen."""

    run_id: UUID
    image_size: tuple[int, int]
    sd_px: Rows
    sd_mdeg: Rows
    residual_rms_px: Rows
    corners: list[list[int]]
    working_zone: Rectangle
    valid_region: Rectangle


def read_maps(session: Session, run_id: UUID) -> ResultMaps:
    """Return the maps of a run's result; raises NotFound for an unknown run and for one without a result."""
    stored = load_camera(session, run_id)
    size = stored.intrinsics.image_size
    promised = predict_map(stored.intrinsics, stored.camera.covariance, ImageGrid(size), stored.working_zone)
    left = _residuals(session, stored)
    return ResultMaps(
        run_id=run_id,
        image_size=size,
        sd_px=rows_of(promised.sd_px),
        sd_mdeg=rows_of(promised.sd_mdeg),
        residual_rms_px=rows_of(left.rms_px),
        corners=left.corners.tolist(),
        working_zone=rectangle_of(stored.working_zone),
        valid_region=rectangle_of(stored.valid_region),
    )


def _residuals(session: Session, stored: StoredCamera) -> ResidualMap:
    query = select(CaptureRow.id, CaptureRow.corners).where(CaptureRow.run_id == stored.run_id)
    corners = {str(capture_id): found for capture_id, found in session.execute(query)}
    seen = np.concatenate([np.array(corners[view["capture_id"]]).reshape(-1, 2) for view in stored.views])
    residuals = np.concatenate([np.array(view["residuals"]).reshape(-1, 2) for view in stored.views])
    return measure_residuals(seen, residuals, ImageGrid(stored.intrinsics.image_size, RESIDUAL_COLUMNS))
