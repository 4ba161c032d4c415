"""Extrinsics may be measured after their run, with its stored intrinsics, from pictures of their own.

Revision 8c41f7e2d905, after 5ab0d7c86e12, 2026-11-27 17:20 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "8c41f7e2d905"
down_revision: str | Sequence[str] | None = "5ab0d7c86e12"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None

VERDICT = sa.Enum(
    "PASS", "MARGINAL", "FAIL", name="verdict", native_enum=False, create_constraint=True, length=16
)


def upgrade() -> None:
    op.create_table(
        "later_extrinsics",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("run_id", sa.Uuid(), nullable=False),
        sa.Column("station_id", sa.Uuid(), nullable=False),
        sa.Column("request_sha256", sa.String(), nullable=False),
        sa.Column("fixture", sa.JSON(), nullable=False),
        sa.Column("verdict", VERDICT, nullable=False),
        sa.Column("document", sa.JSON(), nullable=False),
        sa.Column("versions", sa.JSON(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("created_by", sa.String(), nullable=False),
        *(
            sa.ForeignKeyConstraint(
                [f"{other}_id"],
                [f"{other}.id"],
                name=op.f(f"fk_later_extrinsics_{other}_id_{other}"),
                initially="DEFERRED",
                deferrable=True,
            )
            for other in ("run", "station")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_later_extrinsics")),
        sa.UniqueConstraint(
            "run_id", "request_sha256", name=op.f("uq_later_extrinsics_run_id_request_sha256")
        ),
    )
    op.create_index(
        op.f("ix_later_extrinsics_run_id_created_at_id"), "later_extrinsics", ["run_id", "created_at", "id"]
    )
    op.create_table(
        "later_picture",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("later_extrinsics_id", sa.Uuid(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("file_name", sa.String(), nullable=False),
        sa.Column("sha256", sa.String(), nullable=False),
        sa.Column("media_type", sa.String(), nullable=False),
        sa.Column("bytes", sa.Integer(), nullable=False),
        sa.Column("image_size", sa.JSON(), nullable=False),
        sa.Column("corners", sa.JSON(), nullable=False),
        sa.Column("corner_ids", sa.JSON(), nullable=False),
        sa.Column("sharpness", sa.JSON(), nullable=False),
        sa.Column("parity_separation", sa.Double(), nullable=False),
        sa.Column("contrast", sa.Double(), nullable=False),
        sa.Column("saturated_share", sa.Double(), nullable=True),
        sa.CheckConstraint("number >= 1", name=op.f("ck_later_picture_number_from_1")),
        sa.CheckConstraint("length(sha256) = 64", name=op.f("ck_later_picture_sha256_is_hex")),
        sa.ForeignKeyConstraint(
            ["later_extrinsics_id"],
            ["later_extrinsics.id"],
            name=op.f("fk_later_picture_later_extrinsics_id_later_extrinsics"),
            initially="DEFERRED",
            deferrable=True,
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_later_picture")),
        sa.UniqueConstraint(
            "later_extrinsics_id", "number", name=op.f("uq_later_picture_later_extrinsics_id_number")
        ),
    )
    op.create_index(op.f("ix_later_picture_sha256"), "later_picture", ["sha256"])


def downgrade() -> None:
    op.drop_table("later_picture")
    op.drop_table("later_extrinsics")
