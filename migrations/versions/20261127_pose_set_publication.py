"""Pose sets say who published them, and who retired them when.

What is known of before is filled in: the publisher from the audit trail; a retired set was retired by the
next publication of its SKU revision.

Revision e7d2495b8c13, after 2f7a90c4e1d3, 2026-11-27 10:00 UTC.
"""

from collections.abc import Sequence
from itertools import pairwise
from uuid import UUID

import sqlalchemy as sa
from alembic import op

revision: str = "e7d2495b8c13"
down_revision: str | Sequence[str] | None = "2f7a90c4e1d3"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None

POSE_SET = sa.table(
    "pose_set",
    sa.column("id", sa.Uuid()),
    sa.column("sku_revision_id", sa.Uuid()),
    sa.column("state", sa.String()),
    sa.column("published_at", sa.DateTime(timezone=True)),
    sa.column("published_by", sa.String()),
    sa.column("retired_at", sa.DateTime(timezone=True)),
    sa.column("retired_by", sa.String()),
)
AUDIT_ENTRY = sa.table(
    "audit_entry",
    sa.column("action", sa.String()),
    sa.column("subject", sa.String()),
    sa.column("who", sa.String()),
)


def upgrade() -> None:
    op.add_column("pose_set", sa.Column("published_by", sa.String(), nullable=True))
    op.add_column("pose_set", sa.Column("retired_at", sa.DateTime(timezone=True), nullable=True))
    op.add_column("pose_set", sa.Column("retired_by", sa.String(), nullable=True))
    _fill_in(op.get_bind())


def downgrade() -> None:
    for name in ("retired_by", "retired_at", "published_by"):
        op.drop_column("pose_set", name)


def _fill_in(connection: sa.Connection) -> None:
    who = {
        UUID(subject.removeprefix("pose-set:")): name
        for subject, name in connection.execute(
            sa.select(AUDIT_ENTRY.c.subject, AUDIT_ENTRY.c.who).where(
                AUDIT_ENTRY.c.action == "pose-set.publish"
            )
        )
    }
    columns = POSE_SET.c
    published = connection.execute(
        sa.select(columns.id, columns.sku_revision_id, columns.state, columns.published_at)
        .where(columns.published_at.is_not(None))
        .order_by(columns.sku_revision_id, columns.published_at)
    ).all()
    for row in published:
        _set(connection, row.id, published_by=who.get(row.id))
    for row, following in pairwise(published):
        if row.state == "retired" and row.sku_revision_id == following.sku_revision_id:
            _set(connection, row.id, retired_at=following.published_at, retired_by=who.get(following.id))


def _set(connection: sa.Connection, pose_set_id: UUID, **values: object) -> None:
    connection.execute(sa.update(POSE_SET).where(POSE_SET.c.id == pose_set_id).values(**values))
