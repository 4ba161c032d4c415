"""Stations say where their live frames come from.

Revision 8b3f60d1c952, after 5d0c1b7e4a21, 2026-11-22 08:30 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "8b3f60d1c952"
down_revision: str | Sequence[str] | None = "5d0c1b7e4a21"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    with op.batch_alter_table("station") as station:
        # Stations of before have a camera at the kiosk.
        station.add_column(sa.Column("source", sa.String(16), nullable=False, server_default="browser"))
        station.create_check_constraint(op.f("ck_station_source"), "source IN ('browser', 'virtual')")


def downgrade() -> None:
    with op.batch_alter_table("station") as station:
        station.drop_constraint(op.f("ck_station_source"), type_="check")
        station.drop_column("source")
