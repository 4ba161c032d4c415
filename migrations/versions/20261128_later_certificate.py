"""Extrinsics that are measured after their run have a signed certificate.

Revision f27b80d5c39e, after 8c41f7e2d905, 2026-11-28 08:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "f27b80d5c39e"
down_revision: str | Sequence[str] | None = "8c41f7e2d905"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    # Measurements of before get their certificate when it is first asked for.
    op.create_table(
        "later_certificate",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("later_extrinsics_id", sa.Uuid(), nullable=False),
        sa.Column("key_id", sa.String(), nullable=False),
        sa.Column("token", sa.String(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(
            ["later_extrinsics_id"],
            ["later_extrinsics.id"],
            name=op.f("fk_later_certificate_later_extrinsics_id_later_extrinsics"),
            initially="DEFERRED",
            deferrable=True,
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_later_certificate")),
        sa.UniqueConstraint("later_extrinsics_id", name=op.f("uq_later_certificate_later_extrinsics_id")),
    )


def downgrade() -> None:
    op.drop_table("later_certificate")
