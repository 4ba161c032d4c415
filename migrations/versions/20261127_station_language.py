"""A station may say in which language its kiosk starts.

Revision b6c4f2a81d97, after e7d2495b8c13, 2026-11-27 11:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "b6c4f2a81d97"
down_revision: str | Sequence[str] | None = "e7d2495b8c13"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    with op.batch_alter_table("station") as station:
        # Stations of before leave it to the browser.
        station.add_column(sa.Column("language", sa.String(16), nullable=True))
        station.create_check_constraint(op.f("ck_station_language"), "language IN ('en', 'de', 'zh')")


def downgrade() -> None:
    with op.batch_alter_table("station") as station:
        station.drop_constraint(op.f("ck_station_language"), type_="check")
        station.drop_column("language")
