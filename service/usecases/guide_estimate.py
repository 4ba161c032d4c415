"""What the captures so far say of the camera, within milliseconds: parameters, sd and mapping error.

For the operator's and the engineer's eyes, and for when it is worth judging. Not here: the result, which is
solved from two starts and judged by every gate.
"""

from dataclasses import dataclass
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import DegenerateViews, TooFewViews
from service.core.quality.coverage import default_working_zone, zone_grid
from service.core.quality.early_finish import proven_mapping_px
from service.core.vision.calibration import View, refine_intrinsics
from service.core.vision.uncertainty import mapping_error
from service.storage.models import CaptureRow
from service.storage.words import CaptureRole
from service.usecases.observation import number_or_null
from service.usecases.sku_document import Revision

VIEWS_NEEDED = 3


@dataclass(frozen=True)
class Estimate:
    """The camera as some captures determine it.

    mapping_mean_px, mapping_worst_px: expected over the working zone; None where the lens does not reach it.
    reached: the required mean mapping error over the present one, at most 1. is_proven: also with the noise
    as large as it may well be.
    """

    captures: int
    parameters: dict[str, float]
    sd: dict[str, float]
    mapping_mean_px: float | None
    mapping_worst_px: float | None
    required_mapping_px: float
    reached: float
    is_proven: bool


def estimate_so_far(session: Session, run_id: UUID, revision: Revision) -> Estimate | None:
    """Return what the captures of a run say so far; None while they do not determine the camera."""
    points = revision.target.object_points
    query = select(CaptureRow.corner_ids, CaptureRow.corners).where(
        CaptureRow.run_id == run_id, CaptureRow.role == CaptureRole.INTRINSICS
    )
    views = [
        View(points[np.array(ids)], np.array(corners, dtype=np.float64).reshape(-1, 2))
        for ids, corners in session.execute(query.order_by(CaptureRow.number))
    ]
    return estimate_from(views, revision)


def estimate_from(views: list[View], revision: Revision) -> Estimate | None:
    """Return what views say; None while they do not determine the camera."""
    if len(views) < VIEWS_NEEDED:
        return None
    try:
        result = refine_intrinsics(views, revision.intrinsics, revision.fixed)
    except (TooFewViews, DegenerateViews):
        return None
    if not result.starts[0].converged:
        return None
    zone = revision.working_zone or default_working_zone(revision.intrinsics.image_size)
    mapping = mapping_error(result.intrinsics, result.covariance, zone_grid(zone))
    required_px = revision.required_mapping_px
    return Estimate(
        captures=len(views),
        parameters=result.intrinsics.parameters,
        sd=result.sd,
        mapping_mean_px=number_or_null(mapping.mean_px),
        mapping_worst_px=number_or_null(mapping.worst_px),
        required_mapping_px=required_px,
        reached=min(1.0, required_px / mapping.mean_px) if mapping.mean_px > 0 else 1.0,
        is_proven=proven_mapping_px(result, mapping) <= required_px,
    )
