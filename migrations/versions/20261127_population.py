"""SKU revisions have populations: sums over their cameras, and the states by which results were judged.

Revision 9c27b5e4f013, after d3e81f60b7a4, 2026-11-27 18:30 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "9c27b5e4f013"
down_revision: str | Sequence[str] | None = "d3e81f60b7a4"
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def upgrade() -> None:
    op.create_table(
        "population_moments",
        sa.Column("sku_revision_id", sa.Uuid(), nullable=False),
        sa.Column("units", sa.Integer(), nullable=False),
        sa.Column("mean", sa.JSON(), nullable=False),
        sa.Column("scatter", sa.JSON(), nullable=False),
        sa.Column("own", sa.JSON(), nullable=False),
        sa.Column("updated_at", sa.DateTime(timezone=True), nullable=False),
        _refers_to("population_moments", "sku_revision"),
        sa.PrimaryKeyConstraint("sku_revision_id", name=op.f("pk_population_moments")),
    )
    op.create_table(
        "population_unit",
        sa.Column("sku_revision_id", sa.Uuid(), nullable=False),
        sa.Column("serial", sa.String(), nullable=False),
        sa.Column("run_id", sa.Uuid(), nullable=False),
        sa.Column("is_counted", sa.Boolean(), nullable=False),
        _refers_to("population_unit", "run"),
        _refers_to("population_unit", "sku_revision"),
        sa.PrimaryKeyConstraint("sku_revision_id", "serial", name=op.f("pk_population_unit")),
    )
    op.create_table(
        "population",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("sku_revision_id", sa.Uuid(), nullable=False),
        sa.Column("units", sa.Integer(), nullable=False),
        sa.Column("mean", sa.JSON(), nullable=False),
        sa.Column("between", sa.JSON(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        _refers_to("population", "sku_revision"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_population")),
        sa.UniqueConstraint("sku_revision_id", "units", name=op.f("uq_population_sku_revision_id_units")),
    )


def downgrade() -> None:
    op.drop_table("population")
    op.drop_table("population_unit")
    op.drop_table("population_moments")


def _refers_to(table: str, other: str) -> sa.ForeignKeyConstraint:
    return sa.ForeignKeyConstraint(
        [f"{other}_id"],
        [f"{other}.id"],
        name=op.f(f"fk_{table}_{other}_id_{other}"),
        initially="DEFERRED",
        deferrable=True,
    )
