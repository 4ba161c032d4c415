"""Captures: accept an image into a run, show it, withdraw it.

An image is accepted when it is what the SKU asks for: its size, its target, not in the run already. How
well it meets its pose is reported here and judged by the gates when the run is finished. Slow work
(decoding, detection, storing the image) is done between two transactions; the image is stored before its
row, so that no row lacks its image.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from service.core.errors import (
    DuplicateImage,
    Fact,
    NotFound,
    PoseIndexUnknown,
    PoseTaken,
    ValidationFailed,
)
from service.core.run import check_open
from service.core.vision.fixture_problems import FixtureChanged, FixtureMissing
from service.core.vision.target import parse_target
from service.ports import BlobStore
from service.storage.database import Database
from service.storage.models import CaptureRow, RunRow, SkuRevisionRow, StationRow
from service.storage.words import CaptureRole
from service.usecases.audit import record
from service.usecases.capture_views import CaptureDetailView, view_capture_detail
from service.usecases.fixture_document import FixtureDocument
from service.usecases.images import image_sha256
from service.usecases.observation import (
    Observation,
    Picture,
    Prescription,
    number_or_null,
    observe,
    pose_to_json,
    sharpness_to_json,
)
from service.usecases.run_poses import read_added, read_prescribed, view_added
from service.usecases.runs import get_run
from service.usecases.sku_document import SkuDocument

NO_FACTS: Mapping[str, Fact] = {}


@dataclass(frozen=True)
class Accepted:
    """A capture that is in the run, and whether this upload put it there."""

    view: CaptureDetailView
    is_new: bool


def add_capture(
    database: Database,
    blobs: BlobStore,
    run_id: UUID,
    picture: Picture,
    *,
    pose_index: int | None,
    role: CaptureRole = CaptureRole.INTRINSICS,
    who: str,
    now: datetime,
    facts: Mapping[str, Fact] = NO_FACTS,
) -> Accepted:
    """Accept an image into a run; the same image for the same pose is accepted once and answered again.

    role: an image for the extrinsics shows the fixed target of the run's station, at no pose of the run.
    facts: what else the audit trail is to hold about the image, such as its camera.

    Raises NotFound, RunAlreadyFinished, RunAborted, PoseIndexUnknown, PoseTaken, DuplicateImage,
    FixtureMissing, FixtureChanged, and what `observe` raises.
    """
    sha256 = image_sha256(picture.content)
    with database.read() as session:
        known = _find_same(session, run_id, sha256, pose_index, role)
        if known is not None:
            return Accepted(known, is_new=False)
        fixture = _fixture(session, run_id, pose_index) if role is CaptureRole.EXTRINSICS else None
        prescription = _prescription(session, run_id, pose_index, fixture)
    observation = observe(picture, prescription)
    blobs.put(picture.content)
    with database.write() as session:
        run = lock_open_run(session, run_id)
        # The same image may have come in meanwhile, by a repeated request.
        known = _find_same(session, run_id, sha256, pose_index, role)
        if known is not None:
            return Accepted(known, is_new=False)
        row = _insert(session, run, picture, observation, sha256=sha256, pose_index=pose_index, now=now)
        row.role, row.fixture = role, None if fixture is None else fixture.to_json()
        facts = {**facts, "number": row.number, "sha256": sha256, "role": role.value}
        record(session, now, who, "capture.add", f"run:{run_id}", **facts)
        return Accepted(view_capture_detail(session, row), is_new=True)


def picture_columns(number: int, picture: Picture, observation: Observation, sha256: str) -> dict[str, Any]:
    """Return what a row holds of a picture and of what was seen in it; number: within what it belongs to."""
    detection = observation.detection
    return {
        "number": number,
        "file_name": picture.file_name or f"capture-{number}",
        "sha256": sha256,
        "media_type": observation.media_type,
        "bytes": len(picture.content),
        "image_size": list(detection.image_size),
        "corners": detection.image_points.tolist(),
        "corner_ids": detection.corner_ids.tolist(),
        "sharpness": sharpness_to_json(detection.sharpness),
        "parity_separation": float(detection.parity_separation),
        "contrast": float(detection.contrast),
        "saturated_share": number_or_null(detection.saturated_share),
    }


def get_capture(session: Session, capture_id: UUID) -> CaptureRow:
    """Return a capture; raises NotFound."""
    row = session.get(CaptureRow, capture_id)
    if row is None:
        raise NotFound("There is no capture of this id. Read its run to find it.", capture_id=str(capture_id))
    return row


def read_capture(session: Session, capture_id: UUID) -> CaptureDetailView:
    """Return a capture with its corners; raises NotFound."""
    return view_capture_detail(session, get_capture(session, capture_id))


def withdraw_capture(session: Session, run_id: UUID, capture_id: UUID, who: str, now: datetime) -> None:
    """Take a capture out of an open run; raises NotFound, RunAlreadyFinished, RunAborted.

    The image stays in the store: it is kept under its content, which another run may hold too.
    """
    lock_open_run(session, run_id)
    row = get_capture(session, capture_id)
    if row.run_id != run_id:
        raise NotFound(
            "The run has no capture of this id. Read the run to find it.", capture_id=str(capture_id)
        )
    session.delete(row)
    record(session, now, who, "capture.withdraw", f"run:{run_id}", number=row.number, sha256=row.sha256)


def lock_open_run(session: Session, run_id: UUID) -> RunRow:
    """Return an open run that nobody else changes in this transaction.

    Raises NotFound and what `check_open` raises.
    """
    run = get_run(session, run_id, lock=True)
    check_open(run.state, str(run_id))
    return run


def _find_same(
    session: Session, run_id: UUID, sha256: str, pose_index: int | None, role: CaptureRole
) -> CaptureDetailView | None:
    row = session.scalar(select(CaptureRow).where(CaptureRow.run_id == run_id, CaptureRow.sha256 == sha256))
    if row is None:
        return None
    if (row.pose_index, row.role) != (pose_index, role):
        raise DuplicateImage(
            f"This very image is capture {row.number} of the run already, for "
            f"{'the fixed target' if row.fixture else f'pose {row.pose_index}'}. Take a new image.",
            capture=f"/api/v1/captures/{row.id}",
            number=row.number,
            pose_index=row.pose_index,
        )
    return view_capture_detail(session, row)


def _fixture(session: Session, run_id: UUID, pose_index: int | None) -> FixtureDocument:
    """Return the fixture of a run's station, for a picture of its target."""
    if pose_index is not None:
        raise ValidationFailed(
            "A picture of the fixed target belongs to no pose of the run: leave pose_index out.",
            pointer="/pose_index",
        )
    station_id = get_run(session, run_id).station_id
    stored = None if station_id is None else session.get_one(StationRow, station_id).fixture
    if stored is None:
        raise FixtureMissing(
            "Nobody said where the fixed target of this run's station stands. Give the station its fixture, "
            "or open the run at a station that has one.",
            run=f"/api/v1/runs/{run_id}",
        )
    query = select(CaptureRow.fixture).where(
        CaptureRow.run_id == run_id, CaptureRow.role == CaptureRole.EXTRINSICS
    )
    if any(fixture != stored for fixture in session.scalars(query)):
        raise FixtureChanged(
            "The station's fixture was changed since this run's first picture of it. Withdraw those pictures "
            "and take them again.",
            run=f"/api/v1/runs/{run_id}",
        )
    return FixtureDocument.model_validate(stored)


def _prescription(
    session: Session, run_id: UUID, pose_index: int | None, fixture: FixtureDocument | None
) -> Prescription:
    run = get_run(session, run_id)
    check_open(run.state, str(run_id))
    document = session.get_one(SkuRevisionRow, run.sku_revision_id).document
    revision = SkuDocument.model_validate(document).to_revision()
    if fixture is not None:
        return Prescription(revision.intrinsics, parse_target(fixture.target), None)
    prescribed, added = read_prescribed(session, run) or (), read_added(session, run_id)
    poses = (*prescribed, *(view_added(row).pose for row in added))
    if pose_index is not None and pose_index >= len(poses):
        raise PoseIndexUnknown(
            f"The run has {len(poses)} poses, numbered from 0; there is no pose {pose_index}.",
            poses=len(poses),
            pose_index=pose_index,
        )
    pose = None if pose_index is None else poses[pose_index]
    return Prescription(revision.intrinsics, revision.target, pose)


def _insert(
    session: Session,
    run: RunRow,
    picture: Picture,
    observation: Observation,
    *,
    sha256: str,
    pose_index: int | None,
    now: datetime,
) -> CaptureRow:
    _check_pose_is_free(session, run.id, pose_index)
    last = session.scalar(select(func.max(CaptureRow.number)).where(CaptureRow.run_id == run.id)) or 0
    row = CaptureRow(
        run_id=run.id,
        pose_index=pose_index,
        **picture_columns(last + 1, picture, observation, sha256),
        pose=None if observation.pose is None else pose_to_json(observation.pose),
        match_error_px=observation.match_error_px,
        created_at=now,
    )
    session.add(row)
    session.flush()
    return row


def _check_pose_is_free(session: Session, run_id: UUID, pose_index: int | None) -> None:
    if pose_index is None:
        return
    query = select(CaptureRow).where(CaptureRow.run_id == run_id, CaptureRow.pose_index == pose_index)
    taken = session.scalar(query)
    if taken is not None:
        raise PoseTaken(
            f"Pose {pose_index} has capture {taken.number} already. Withdraw that capture to take the "
            "pose again.",
            capture=f"/api/v1/captures/{taken.id}",
            number=taken.number,
        )
