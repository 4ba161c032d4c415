"""Pose sets: plan one in the background, import one, look at it, publish it, export it, retire it.

Not here: what a set is explained with (`pose_set_review`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound, StateForbids
from service.core.planning.document import pose_from_dict
from service.core.vision.target import Target
from service.core.vision.transforms import Pose
from service.ports import JobQueue
from service.storage.models import JobRow, PoseSetRow, SkuRevisionRow, SkuRow
from service.storage.words import Publication
from service.usecases.audit import record
from service.usecases.observation import outer_corners
from service.usecases.paging import PageRequest, Part, page_of
from service.usecases.planning import PLAN_POSE_SET, PlanRequest, describe_import
from service.usecases.pose_set_document import (
    NO_CLAIM,
    Claim,
    check_claim,
    check_in_image,
    pose_set_document,
)
from service.usecases.publication import publish, retire
from service.usecases.sku_document import Revision, SkuDocument
from service.usecases.skus import SkuReference, get_revision, read_sku

JsonObject = dict[str, Any]
Triple = tuple[float, float, float]


@dataclass(frozen=True)
class PoseView:
    """A pose, and where it puts the outer corners of the board in the nominal camera's image."""

    rvec: list[float]
    tvec: list[float]
    outer_corners: list[list[float]]


@dataclass(frozen=True)
class PoseSetView:
    """A pose set as it is shown; prediction is None as long as it is planned."""

    id: UUID
    sku: SkuReference
    state: Publication
    poses: list[PoseView]
    prediction: JsonObject | None
    provenance: JsonObject
    job_id: UUID | None
    created_at: datetime
    published_at: datetime | None
    published_by: str | None
    retired_at: datetime | None
    retired_by: str | None


@dataclass(frozen=True)
class PoseSetSummary:
    """A pose set in a list: without its poses."""

    id: UUID
    sku: SkuReference
    state: Publication
    pose_count: int
    prediction: JsonObject | None
    created_at: datetime
    published_at: datetime | None


@dataclass(frozen=True)
class Requested:
    """A new pose set, and the job that plans it if it is not imported."""

    pose_set: PoseSetView
    job: JobRow | None


def request_pose_set(
    session: Session, queue: JobQueue, code: str, number: int, plan: PlanRequest, *, who: str, now: datetime
) -> Requested:
    """Create an empty pose set and queue the job that plans it; raises NotFound."""
    revision = get_revision(session, code, number)
    row = PoseSetRow(
        sku_revision_id=revision.id, poses=[], prediction={}, provenance=plan.to_json(), created_at=now
    )
    row.job_id = queue.enqueue(session, PLAN_POSE_SET, {"pose_set_id": str(row.id)})
    session.add(row)
    session.flush()
    record(session, now, who, "pose-set.request", f"pose-set:{row.id}", sku=code, revision=number)
    return Requested(_view(session, row), session.get_one(JobRow, row.job_id))


def import_pose_set(
    session: Session,
    code: str,
    number: int,
    poses: Sequence[tuple[Triple, Triple]],
    claim: Claim = NO_CLAIM,
    *,
    who: str,
    now: datetime,
) -> Requested:
    """Store given poses as a draft: rotation vector, rad, and translation, m, of `T_cam_board`.

    claim: for which camera they were made, as far as that is said. Raises NotFound, PoseSetMismatch for
    another camera's poses, and PoseSetInfeasible for poses that are of no use.
    """
    revision = get_revision(session, code, number)
    camera = _revision(revision)
    check_claim(claim, camera)
    given = [Pose(np.array(rvec, dtype=np.float64), np.array(tvec, dtype=np.float64)) for rvec, tvec in poses]
    check_in_image(camera, given)
    document = describe_import(camera, given)
    document["provenance"] |= claim.origin
    row = PoseSetRow(sku_revision_id=revision.id, created_at=now, **document)
    session.add(row)
    session.flush()
    record(session, now, who, "pose-set.import", f"pose-set:{row.id}", sku=code, revision=number)
    return Requested(_view(session, row), None)


def read_pose_set(session: Session, pose_set_id: UUID) -> PoseSetView:
    """Return a pose set; raises NotFound."""
    return _view(session, get_pose_set(session, pose_set_id))


def list_pose_sets(session: Session, code: str, page: PageRequest) -> Part[PoseSetSummary]:
    """Return a part of the pose sets of all revisions of a SKU, newest first; raises NotFound."""
    numbers = {row.id: row.number for row in read_sku(session, code).revisions}
    query = select(PoseSetRow).where(PoseSetRow.sku_revision_id.in_(numbers))
    part = page_of(session, query, PoseSetRow, page)
    return Part(
        [
            PoseSetSummary(
                id=row.id,
                sku=SkuReference(code, numbers[row.sku_revision_id]),
                state=row.state,
                pose_count=len(row.poses),
                prediction=row.prediction or None,
                created_at=row.created_at,
                published_at=row.published_at,
            )
            for row in part.items
        ],
        part.next_cursor,
    )


def publish_pose_set(session: Session, pose_set_id: UUID, who: str, now: datetime) -> PoseSetView:
    """Publish a planned set and retire the one before it; publishing a published one changes nothing.

    Raises NotFound, and StateForbids while it has no poses or when it is retired.
    """
    row = get_pose_set(session, pose_set_id)
    _check_planned(row)
    # The lock on the revision keeps two publications at the same moment from both staying published.
    session.get(SkuRevisionRow, row.sku_revision_id, with_for_update=True)
    session.refresh(row)
    siblings = session.scalars(
        select(PoseSetRow).where(PoseSetRow.sku_revision_id == row.sku_revision_id, PoseSetRow.id != row.id)
    ).all()
    replaced = [sibling for sibling in siblings if sibling.state is Publication.PUBLISHED]
    if publish(row, list(siblings), now):
        row.published_by = who
        for sibling in replaced:
            sibling.retired_at, sibling.retired_by = now, who
        record(session, now, who, "pose-set.publish", f"pose-set:{row.id}")
    return _view(session, row)


def retire_pose_set(session: Session, pose_set_id: UUID, who: str, now: datetime) -> PoseSetView:
    """Retire a published set; runs that are open keep it. Retiring a retired one changes nothing.

    Raises NotFound, and StateForbids for a draft.
    """
    row = get_pose_set(session, pose_set_id)
    # The lock that publications take, so that one of them and this cannot pass each other.
    session.get(SkuRevisionRow, row.sku_revision_id, with_for_update=True)
    session.refresh(row)
    if retire(row, who, now):
        record(session, now, who, "pose-set.retire", f"pose-set:{row.id}")
    return _view(session, row)


def export_pose_set(session: Session, pose_set_id: UUID) -> JsonObject:
    """Return a pose set as the document that `dmscal plan --out` writes and that can be imported.

    Raises NotFound, and StateForbids while it has no poses.
    """
    row = get_pose_set(session, pose_set_id)
    _check_planned(row)
    revision_row = session.get_one(SkuRevisionRow, row.sku_revision_id)
    content = {"poses": row.poses, "prediction": row.prediction, "provenance": row.provenance}
    return pose_set_document(_revision(revision_row), revision_row.number, content)


def get_pose_set(session: Session, pose_set_id: UUID) -> PoseSetRow:
    """Return the row of a pose set; raises NotFound."""
    row = session.get(PoseSetRow, pose_set_id)
    if row is None:
        raise NotFound("There is no pose set of this id.", pose_set_id=str(pose_set_id))
    return row


def _check_planned(row: PoseSetRow) -> None:
    if not row.poses:
        raise StateForbids(
            "The pose set has no poses yet. Wait until its job is done; when that failed, request a new set.",
            job=None if row.job_id is None else f"/api/v1/jobs/{row.job_id}",
        )


def _revision(row: SkuRevisionRow) -> Revision:
    return SkuDocument.model_validate(row.document).to_revision()


def _view(session: Session, row: PoseSetRow) -> PoseSetView:
    revision_row = session.get_one(SkuRevisionRow, row.sku_revision_id)
    sku = session.get_one(SkuRow, revision_row.sku_id)
    revision = _revision(revision_row)
    return PoseSetView(
        id=row.id,
        sku=SkuReference(sku.code, revision_row.number),
        state=row.state,
        poses=[_pose_view(revision, revision.target, stored) for stored in row.poses],
        prediction=row.prediction or None,
        provenance=row.provenance,
        job_id=row.job_id,
        created_at=row.created_at,
        published_at=row.published_at,
        published_by=row.published_by,
        retired_at=row.retired_at,
        retired_by=row.retired_by,
    )


def _pose_view(revision: Revision, target: Target, stored: JsonObject) -> PoseView:
    corners = outer_corners(revision.intrinsics, target, pose_from_dict(stored))
    return PoseView(stored["rvec"], stored["tvec"], corners.tolist())
