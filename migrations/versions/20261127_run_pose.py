"""Runs may ask for poses beyond their pose set.

Revision d17a5e0c2b94, after 94d1e6b07a35, 2026-11-27 12:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "d17a5e0c2b94"
down_revision: str | Sequence[str] | None = "94d1e6b07a35"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    op.create_table(
        "run_pose",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("run_id", sa.Uuid(), nullable=False),
        sa.Column("pose_index", sa.Integer(), nullable=False),
        sa.Column("pose", sa.JSON(), nullable=False),
        sa.Column("reason", sa.String(16), nullable=False),
        sa.Column("replaces", sa.Integer(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.CheckConstraint(
            "reason IN ('accuracy', 'weak-capture', 'out-of-reach')", name=op.f("ck_run_pose_reason")
        ),
        sa.ForeignKeyConstraint(
            ["run_id"],
            ["run.id"],
            name=op.f("fk_run_pose_run_id_run"),
            initially="DEFERRED",
            deferrable=True,
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_run_pose")),
        sa.UniqueConstraint("run_id", "pose_index", name=op.f("uq_run_pose_run_id_pose_index")),
    )


def downgrade() -> None:
    op.drop_table("run_pose")
