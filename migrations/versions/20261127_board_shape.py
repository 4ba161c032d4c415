"""Boards have a shape that is learnt from runs; runs remember which board they were taken with.

Revision 5ab0d7c86e12, after 5be2c07f4a13, 2026-11-27 19:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "5ab0d7c86e12"
down_revision: str | Sequence[str] | None = "5be2c07f4a13"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None

INDEX = "ix_run_target_id_state_created_at_id"
STATE = sa.Enum(
    "draft", "certified", "retired", name="state", native_enum=False, create_constraint=True, length=16
)


def upgrade() -> None:
    with op.batch_alter_table("target") as target:
        target.add_column(sa.Column("drift_limit_mm", sa.Double(), server_default="0.1", nullable=False))
    with op.batch_alter_table("run") as run:
        # Runs of before do not tell: their station may have another board by now.
        run.add_column(sa.Column("target_id", sa.Uuid(), nullable=True))
        run.create_foreign_key(
            op.f("fk_run_target_id_target"),
            "target",
            ["target_id"],
            ["id"],
            initially="DEFERRED",
            deferrable=True,
        )
    op.create_index(op.f(INDEX), "run", ["target_id", "state", "created_at", "id"])
    op.create_table(
        "board_shape",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("target_id", sa.Uuid(), nullable=False),
        sa.Column("version", sa.Integer(), nullable=False),
        sa.Column("state", STATE, nullable=False),
        sa.Column("deviations", sa.JSON(), nullable=False),
        sa.Column("sd", sa.JSON(), nullable=False),
        sa.Column("run_ids", sa.JSON(), nullable=False),
        sa.Column("bend_mm", sa.Double(), nullable=False),
        sa.Column("in_plane_mm", sa.Double(), nullable=False),
        sa.Column("sigma_flat_px", sa.Double(), nullable=False),
        sa.Column("sigma_px", sa.Double(), nullable=False),
        sa.Column("certainty", sa.JSON(), nullable=False),
        sa.Column("drift", sa.JSON(), nullable=True),
        sa.Column("job_id", sa.Uuid(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("created_by", sa.String(), nullable=False),
        sa.Column("certified_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("certified_by", sa.String(), nullable=True),
        sa.Column("retired_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("retired_by", sa.String(), nullable=True),
        sa.CheckConstraint("version >= 1", name=op.f("ck_board_shape_version_from_1")),
        sa.CheckConstraint(
            "state <> 'certified' OR certified_at IS NOT NULL", name=op.f("ck_board_shape_certified_has_time")
        ),
        sa.ForeignKeyConstraint(
            ["job_id"],
            ["job.id"],
            name=op.f("fk_board_shape_job_id_job"),
            initially="DEFERRED",
            deferrable=True,
        ),
        sa.ForeignKeyConstraint(
            ["target_id"],
            ["target.id"],
            name=op.f("fk_board_shape_target_id_target"),
            initially="DEFERRED",
            deferrable=True,
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_board_shape")),
        sa.UniqueConstraint("target_id", "version", name=op.f("uq_board_shape_target_id_version")),
    )


def downgrade() -> None:
    op.drop_table("board_shape")
    op.drop_index(op.f(INDEX), "run")
    with op.batch_alter_table("run") as run:
        run.drop_constraint(op.f("fk_run_target_id_target"), type_="foreignkey")
        run.drop_column("target_id")
    with op.batch_alter_table("target") as target:
        target.drop_column("drift_limit_mm")
