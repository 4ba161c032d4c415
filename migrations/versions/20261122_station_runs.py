"""An index that finds the newest open and the newest finished run of a station.

Revision c41e97d2a6b8, after 8b3f60d1c952, 2026-11-22 08:34 UTC.
"""

from collections.abc import Sequence

from alembic import op

revision: str = "c41e97d2a6b8"
down_revision: str | Sequence[str] | None = "8b3f60d1c952"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    op.create_index(
        op.f("ix_run_station_id_state_created_at_id"), "run", ["station_id", "state", "created_at", "id"]
    )


def downgrade() -> None:
    op.drop_index(op.f("ix_run_station_id_state_created_at_id"), "run")
