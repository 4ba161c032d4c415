"""Captures know which share of the board's bright squares was saturated.

Revision d3e81f60b7a4, after b6c4f2a81d97, 2026-11-27 18:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "d3e81f60b7a4"
down_revision: str | Sequence[str] | None = "b6c4f2a81d97"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    with op.batch_alter_table("capture") as capture:
        # Captures of before do not tell; nobody looks at their images again.
        capture.add_column(sa.Column("saturated_share", sa.Double(), nullable=True))


def downgrade() -> None:
    with op.batch_alter_table("capture") as capture:
        capture.drop_column("saturated_share")
