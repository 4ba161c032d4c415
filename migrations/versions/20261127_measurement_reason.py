"""Measurements carry the code of what they say, and what it names, so that pages say it in each language.

Revision 3f7a9d52c18e, after c41e97d2a6b8, 2026-11-27 10:00 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "3f7a9d52c18e"
down_revision: str | Sequence[str] | None = "c41e97d2a6b8"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    with op.batch_alter_table("measurement") as measurement:
        # Results of before keep their English sentence only.
        measurement.add_column(sa.Column("reason", sa.String(), nullable=True))
        measurement.add_column(sa.Column("facts", sa.JSON(), nullable=True))


def downgrade() -> None:
    with op.batch_alter_table("measurement") as measurement:
        measurement.drop_column("facts")
        measurement.drop_column("reason")
