"""What the calibration of a run is made from: corners as they were stored, and what the SKU says.

The same input gives the same result to the last digit; images are not needed again.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.evidence import AddedPose, Expectation, FixedTargetViews, NamedDetection
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.run import Purpose
from service.core.vision.detection import Detection
from service.core.vision.target import parse_target
from service.storage.models import CaptureRow, RunRow, SeenPicture, SkuRevisionRow
from service.storage.words import CaptureRole
from service.usecases.board_in_use import BoardInUse, load_board
from service.usecases.fixture_document import FixtureDocument
from service.usecases.identity import load_identity
from service.usecases.observation import JsonObject, sharpness_from_json
from service.usecases.run_poses import read_added, read_prescribed, view_added
from service.usecases.sku_document import Revision, SkuDocument


@dataclass(frozen=True)
class CalibrationInput:
    """The captures of a run in their order, what was detected in them, and what the SKU says.

    capture_ids: of the detections, then of the pictures of the fixed target. identity: names what its camera
    is told from others by, as it is stored with the result; None for results of before. board: the plate,
    where its shape is known.
    """

    run_id: UUID
    capture_ids: tuple[UUID, ...]
    detections: tuple[NamedDetection, ...]
    revision: Revision
    expectation: Expectation
    identity: JsonObject | None
    fixed_target: FixedTargetViews | None
    fixture: JsonObject | None
    board: BoardInUse | None


def load_input(session: Session, run: RunRow) -> CalibrationInput:
    """Return what the calibration of a run is made from."""
    document = session.get_one(SkuRevisionRow, run.sku_revision_id).document
    revision = SkuDocument.model_validate(document).to_revision()
    query = select(CaptureRow).where(CaptureRow.run_id == run.id).order_by(CaptureRow.number)
    all_captures = list(session.scalars(query))
    captures = [one for one in all_captures if one.role is CaptureRole.INTRINSICS]
    of_fixture = [one for one in all_captures if one.role is CaptureRole.EXTRINSICS]
    prescribed = read_prescribed(session, run)
    identity = load_identity(session, run)
    expectation = Expectation(
        nominal=revision.intrinsics,
        limits=revision.limits,
        working_zone=revision.working_zone,
        valid_region=revision.valid_region,
        poses=prescribed,
        pose_of_view=None if prescribed is None else tuple(capture.pose_index for capture in captures),
        other_skus=identity.other_skus,
        population_units=identity.units,
        population=identity.population,
        other_populations=identity.other_populations,
        used_for=_used_for(session, run, [capture.sha256 for capture in captures]),
        added=tuple(
            AddedPose(one.pose, one.replaces) for one in map(view_added, read_added(session, run.id))
        ),
        early_finish=revision.early_finish,
        mounting=revision.mounting,
    )
    return CalibrationInput(
        run_id=run.id,
        capture_ids=tuple(capture.id for capture in (*captures, *of_fixture)),
        detections=tuple(map(detection_of, captures)),
        revision=revision,
        expectation=expectation,
        identity=identity.reference,
        board=load_board(session, run, revision.target),
        fixed_target=_fixed_target(of_fixture) if of_fixture else None,
        fixture=of_fixture[0].fixture if of_fixture else None,
    )


def _fixed_target(captures: Sequence[CaptureRow]) -> FixedTargetViews:
    """Return the pictures of the fixed target, with its place as it was when they were taken."""
    document = FixtureDocument.model_validate(captures[0].fixture)
    return FixedTargetViews(
        parse_target(document.target), document.to_fixed_target(), tuple(map(detection_of, captures))
    )


def calibrate(source: CalibrationInput) -> Judged:
    """Calibrate and judge; raises TooFewViews, DegenerateViews, PoseUndetermined."""
    revision = source.revision
    return calibrate_and_judge(
        source.detections,
        revision.target,
        revision.intrinsics.lens,
        source.expectation,
        fixed=revision.fixed,
        fixed_target=source.fixed_target,
        board=None if source.board is None else source.board.corners,
    )


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


def detection_of(picture: SeenPicture) -> NamedDetection:
    """Return what was detected in a picture, as it was stored."""
    width, height = picture.image_size
    detection = Detection(
        image_points=np.array(picture.corners, dtype=np.float64).reshape(-1, 2),
        corner_ids=np.array(picture.corner_ids, dtype=np.int64),
        image_size=(width, height),
        sharpness=sharpness_from_json(picture.sharpness),
        parity_separation=picture.parity_separation,
        contrast=picture.contrast,
        saturated_share=math.nan if picture.saturated_share is None else picture.saturated_share,
    )
    # Names are unique within a run even where stations send every image under the same file name.
    return NamedDetection(f"{picture.number:02d} {picture.file_name}", detection, picture.sha256)
