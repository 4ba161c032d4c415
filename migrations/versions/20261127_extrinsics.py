"""Stations may have a fixture; captures say what they are for, and those of a fixture hold it.

Revision 5be2c07f4a13, after d17a5e0c2b94, 2026-11-27 13:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "5be2c07f4a13"
down_revision: str | Sequence[str] | None = "d17a5e0c2b94"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    with op.batch_alter_table("station") as station:
        station.add_column(sa.Column("fixture", sa.JSON(), nullable=True))
    with op.batch_alter_table("capture") as capture:
        # Captures of before are all of the calibration.
        capture.add_column(sa.Column("role", sa.String(16), nullable=False, server_default="intrinsics"))
        capture.add_column(sa.Column("fixture", sa.JSON(), nullable=True))
        capture.create_check_constraint(op.f("ck_capture_role"), "role IN ('intrinsics', 'extrinsics')")
        capture.create_check_constraint(
            op.f("ck_capture_extrinsics_has_fixture"), "role <> 'extrinsics' OR fixture IS NOT NULL"
        )


def downgrade() -> None:
    # The version before takes every capture for one of the calibration.
    op.execute("DELETE FROM capture WHERE role = 'extrinsics'")
    with op.batch_alter_table("capture") as capture:
        capture.drop_constraint(op.f("ck_capture_extrinsics_has_fixture"), type_="check")
        capture.drop_constraint(op.f("ck_capture_role"), type_="check")
        capture.drop_column("fixture")
        capture.drop_column("role")
    with op.batch_alter_table("station") as station:
        station.drop_column("fixture")
