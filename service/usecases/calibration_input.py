"""What the calibration of a run is made from: corners as they were stored, and what the SKU says.

The same input gives the same result to the last digit; images are not needed again.
"""

from dataclasses import dataclass
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.evidence import AddedPose, Expectation, NamedDetection
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.run import Purpose
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import Detection
from service.storage.models import CaptureRow, RunRow, SkuRevisionRow, SkuRow
from service.storage.words import Publication
from service.usecases.observation import sharpness_from_json
from service.usecases.run_poses import read_added, read_prescribed, view_added
from service.usecases.sku_document import Revision, SkuDocument


@dataclass(frozen=True)
class CalibrationInput:
    """The captures of a run in their order, what was detected in them, and what the SKU says."""

    run_id: UUID
    capture_ids: tuple[UUID, ...]
    detections: tuple[NamedDetection, ...]
    revision: Revision
    expectation: Expectation


def load_input(session: Session, run: RunRow) -> CalibrationInput:
    """Return what the calibration of a run is made from."""
    document = session.get_one(SkuRevisionRow, run.sku_revision_id).document
    revision = SkuDocument.model_validate(document).to_revision()
    query = select(CaptureRow).where(CaptureRow.run_id == run.id).order_by(CaptureRow.number)
    captures = list(session.scalars(query))
    prescribed = read_prescribed(session, run)
    expectation = Expectation(
        nominal=revision.intrinsics,
        limits=revision.limits,
        working_zone=revision.working_zone,
        valid_region=revision.valid_region,
        poses=prescribed,
        pose_of_view=None if prescribed is None else tuple(capture.pose_index for capture in captures),
        other_skus=_other_skus(session, run),
        used_for=_used_for(session, run, [capture.sha256 for capture in captures]),
        added=tuple(
            AddedPose(one.pose, one.replaces) for one in map(view_added, read_added(session, run.id))
        ),
        early_finish=revision.early_finish,
    )
    ids = tuple(capture.id for capture in captures)
    return CalibrationInput(run.id, ids, tuple(map(_detection, captures)), revision, expectation)


def calibrate(source: CalibrationInput) -> Judged:
    """Calibrate and judge; raises TooFewViews, DegenerateViews."""
    revision = source.revision
    return calibrate_and_judge(
        source.detections,
        revision.target,
        revision.intrinsics.lens,
        source.expectation,
        fixed=revision.fixed,
    )


def _other_skus(session: Session, run: RunRow) -> dict[str, Intrinsics]:
    """Return the nominals of all other SKUs' published revisions, by code."""
    own = session.get_one(SkuRevisionRow, run.sku_revision_id).sku_id
    query = (
        select(SkuRow.code, SkuRevisionRow.document)
        .join(SkuRevisionRow, SkuRevisionRow.sku_id == SkuRow.id)
        .where(SkuRevisionRow.state == Publication.PUBLISHED, SkuRow.id != own)
    )
    return {
        code: SkuDocument.model_validate(document).to_revision().intrinsics
        for code, document in session.execute(query)
    }


def _used_for(session: Session, run: RunRow, hashes: list[str]) -> dict[str, str]:
    """Return which images of a run were used before for another serial: that serial by content hash.

    Simulated runs may replay the same pictures for every vehicle.
    """
    if run.purpose is Purpose.SIMULATED:
        return {}
    query = (
        select(CaptureRow.sha256, RunRow.serial)
        .join(RunRow, CaptureRow.run_id == RunRow.id)
        .where(
            CaptureRow.sha256.in_(hashes), RunRow.serial != run.serial, RunRow.created_at <= run.created_at
        )
    )
    return {row.sha256: row.serial for row in session.execute(query)}


def _detection(capture: CaptureRow) -> NamedDetection:
    width, height = capture.image_size
    detection = Detection(
        image_points=np.array(capture.corners, dtype=np.float64).reshape(-1, 2),
        corner_ids=np.array(capture.corner_ids, dtype=np.int64),
        image_size=(width, height),
        sharpness=sharpness_from_json(capture.sharpness),
        parity_separation=capture.parity_separation,
        contrast=capture.contrast,
    )
    # Names are unique within a run even where stations send every image under the same file name.
    return NamedDetection(f"{capture.number:02d} {capture.file_name}", detection, capture.sha256)
