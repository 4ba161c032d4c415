"""The tables of what is learnt over many runs: the populations of SKUs. All others: `models`."""

from datetime import datetime
from uuid import UUID

from sqlalchemy import UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from service.storage.columns import new_id
from service.storage.models import JsonArray, Row, refers_to


class PopulationMomentsRow(Row):
    """Running sums over the cameras of a SKU revision; JSON arrays in the order of its lens's parameters."""

    __tablename__ = "population_moments"

    sku_revision_id: Mapped[UUID] = mapped_column(refers_to("sku_revision.id"), primary_key=True)
    units: Mapped[int]
    mean: Mapped[JsonArray]
    scatter: Mapped[JsonArray]
    own: Mapped[JsonArray]
    updated_at: Mapped[datetime]


class PopulationUnitRow(Row):
    """Which run stands for a serial in its SKU revision's population; one that lies apart is not counted."""

    __tablename__ = "population_unit"

    sku_revision_id: Mapped[UUID] = mapped_column(refers_to("sku_revision.id"), primary_key=True)
    serial: Mapped[str] = mapped_column(primary_key=True)
    run_id: Mapped[UUID] = mapped_column(refers_to("run.id"))
    is_counted: Mapped[bool] = mapped_column(default=True)


class PopulationRow(Row):
    """A population by which results were judged; never changed, so that they can be computed again."""

    __tablename__ = "population"
    __table_args__ = (UniqueConstraint("sku_revision_id", "units"),)

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    sku_revision_id: Mapped[UUID] = mapped_column(refers_to("sku_revision.id"))
    units: Mapped[int]
    mean: Mapped[JsonArray]
    between: Mapped[JsonArray]
    created_at: Mapped[datetime]


ALL_TABLES = Row.metadata  # complete once this module is loaded
