"""SKUs: describe a camera variant, revise it, publish a revision. A published revision is never edited."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from service.core.errors import NotFound, RevisionNotPublished, ValidationFailed
from service.core.quality.limits import LIMIT_NAMES
from service.storage.models import PoseSetRow, SkuRevisionRow, SkuRow
from service.storage.words import Publication
from service.usecases.audit import record
from service.usecases.paging import PageRequest, Part, page_of
from service.usecases.publication import publish
from service.usecases.sku_document import SkuDocument


@dataclass(frozen=True)
class SkuReference:
    """Which revision of which SKU."""

    code: str
    revision: int


@dataclass(frozen=True)
class PublishedPoseSet:
    """The pose set that new runs of a SKU follow, and how many poses it has."""

    id: UUID
    poses: int


@dataclass(frozen=True)
class SkuView:
    """A SKU with the numbers of its revisions that count, and the revisions themselves where asked for."""

    id: UUID
    code: str
    name: str
    latest_revision: int
    published_revision: int | None
    published_pose_set: PublishedPoseSet | None
    created_at: datetime
    revisions: Sequence[SkuRevisionRow]


@dataclass(frozen=True)
class LimitView:
    """A limit in force; from `marginal_share` of it on a value is MARGINAL."""

    name: str
    value: float
    marginal_share: float
    is_default: bool


def create_sku(session: Session, document: SkuDocument, who: str, now: datetime) -> SkuView:
    """Create a SKU with its first revision, a draft; raises AlreadyExists for a code that is taken."""
    row = SkuRow(code=document.code, name=document.name, created_at=now)
    session.add(row)
    session.flush()
    record(session, now, who, "sku.create", f"sku:{row.code}", name=row.name)
    _add_revision(session, row, document, 1, who=who, now=now)
    return _views(session, [row])[0]


def list_skus(session: Session, page: PageRequest) -> Part[SkuView]:
    """Return a part of the SKUs, newest first."""
    part = page_of(session, select(SkuRow), SkuRow, page)
    return Part(_views(session, part.items), part.next_cursor)


def read_sku(session: Session, code: str) -> SkuView:
    """Return a SKU with its revisions, newest first; raises NotFound."""
    row = get_sku(session, code)
    return _views(session, [row])[0]


def get_sku(session: Session, code: str) -> SkuRow:
    """Return a SKU by its code; raises NotFound."""
    row = session.scalar(select(SkuRow).where(SkuRow.code == code))
    if row is None:
        raise NotFound(f"There is no SKU '{code}'. List the SKUs, or create it.", sku=code)
    return row


def add_revision(
    session: Session, code: str, document: SkuDocument, who: str, now: datetime
) -> SkuRevisionRow:
    """Add a draft revision; raises NotFound, and ValidationFailed for a document of another SKU."""
    row = get_sku(session, code)
    if document.code != code:
        raise ValidationFailed(
            f"The document's code is '{document.code}', the address says '{code}'. Send the document of "
            "this SKU.",
            pointer="/code",
        )
    last = session.scalar(select(func.max(SkuRevisionRow.number)).where(SkuRevisionRow.sku_id == row.id))
    return _add_revision(session, row, document, (last or 0) + 1, who=who, now=now)


def list_revisions(session: Session, code: str, page: PageRequest) -> Part[SkuRevisionRow]:
    """Return a part of a SKU's revisions, newest first; raises NotFound."""
    query = select(SkuRevisionRow).where(SkuRevisionRow.sku_id == get_sku(session, code).id)
    return page_of(session, query, SkuRevisionRow, page)


def get_revision(session: Session, code: str, number: int) -> SkuRevisionRow:
    """Return a revision; raises NotFound."""
    sku = get_sku(session, code)
    query = select(SkuRevisionRow).where(SkuRevisionRow.sku_id == sku.id, SkuRevisionRow.number == number)
    row = session.scalar(query)
    if row is None:
        raise NotFound(
            f"SKU '{code}' has no revision {number}. List its revisions.", sku=code, revision=number
        )
    return row


def read_limits(session: Session, code: str, number: int) -> list[LimitView]:
    """Return the limits by which runs of a revision are judged; raises NotFound."""
    document = SkuDocument.model_validate(get_revision(session, code, number).document)
    limits = document.to_revision().limits
    own = {*document.limits, *(document.limits.get("marginal") or {})}
    return [
        LimitView(name, getattr(limits, name), limits.share(name), name not in own) for name in LIMIT_NAMES
    ]


def get_published_revision(session: Session, code: str) -> SkuRevisionRow:
    """Return the revision that runs use; raises NotFound, RevisionNotPublished."""
    sku = get_sku(session, code)
    row = session.scalar(
        select(SkuRevisionRow).where(
            SkuRevisionRow.sku_id == sku.id, SkuRevisionRow.state == Publication.PUBLISHED
        )
    )
    if row is None:
        raise RevisionNotPublished(
            f"SKU '{code}' has no published revision. An engineer publishes one before runs are opened.",
            sku=code,
        )
    return row


def publish_revision(session: Session, code: str, number: int, who: str, now: datetime) -> SkuRevisionRow:
    """Publish a draft and retire the revision before; publishing a published one changes nothing.

    Raises NotFound, and StateForbids for a retired revision.
    """
    # The lock on the SKU keeps two publications at the same moment from both staying published.
    session.get(SkuRow, get_sku(session, code).id, with_for_update=True)
    row = get_revision(session, code, number)
    siblings = _revisions(session, [row.sku_id])
    if publish(row, [sibling for sibling in siblings if sibling is not row], now):
        record(session, now, who, "sku.publish", f"sku:{code}", revision=number)
    return row


def _add_revision(
    session: Session, sku: SkuRow, document: SkuDocument, number: int, *, who: str, now: datetime
) -> SkuRevisionRow:
    row = SkuRevisionRow(
        sku_id=sku.id, number=number, document=document.model_dump(mode="json"), created_at=now
    )
    session.add(row)
    session.flush()
    record(session, now, who, "sku.revise", f"sku:{sku.code}", revision=number)
    return row


def _revisions(session: Session, sku_ids: list[UUID]) -> list[SkuRevisionRow]:
    query = select(SkuRevisionRow).where(SkuRevisionRow.sku_id.in_(sku_ids))
    return list(session.scalars(query.order_by(SkuRevisionRow.number.desc())))


def _views(session: Session, rows: Sequence[SkuRow]) -> list[SkuView]:
    revisions = _revisions(session, [row.id for row in rows])
    published = {row.sku_id: row for row in revisions if row.state is Publication.PUBLISHED}
    pose_sets = _published_pose_sets(session, [row.id for row in published.values()])
    return [
        SkuView(
            id=row.id,
            code=row.code,
            name=row.name,
            latest_revision=max(revision.number for revision in revisions if revision.sku_id == row.id),
            published_revision=published[row.id].number if row.id in published else None,
            published_pose_set=pose_sets.get(published[row.id].id) if row.id in published else None,
            created_at=row.created_at,
            revisions=[revision for revision in revisions if revision.sku_id == row.id],
        )
        for row in rows
    ]


def _published_pose_sets(session: Session, revision_ids: Sequence[UUID]) -> dict[UUID, PublishedPoseSet]:
    query = select(PoseSetRow).where(
        PoseSetRow.sku_revision_id.in_(revision_ids), PoseSetRow.state == Publication.PUBLISHED
    )
    return {row.sku_revision_id: PublishedPoseSet(row.id, len(row.poses)) for row in session.scalars(query)}
