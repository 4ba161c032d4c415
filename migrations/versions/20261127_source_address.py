"""A station's source may be the address of a camera that the service reads.

Revision 2f7a90c4e1d3, after 3f7a9d52c18e, 2026-11-27 10:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "2f7a90c4e1d3"
down_revision: str | Sequence[str] | None = "3f7a9d52c18e"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    with op.batch_alter_table("station") as station:
        station.drop_constraint(op.f("ck_station_source"), type_="check")
        station.alter_column(
            "source", type_=sa.String(), existing_type=sa.String(16), existing_nullable=False
        )


def downgrade() -> None:
    # The version before knows no cameras of the service; their stations get the one at the kiosk.
    op.execute("UPDATE station SET source = 'browser' WHERE source NOT IN ('browser', 'virtual')")
    with op.batch_alter_table("station") as station:
        station.alter_column(
            "source", type_=sa.String(16), existing_type=sa.String(), existing_nullable=False
        )
        station.create_check_constraint(op.f("ck_station_source"), "source IN ('browser', 'virtual')")
