"""The tables of what is learnt over many runs: populations of SKUs and shapes of boards. Others: `models`."""

from datetime import datetime
from uuid import UUID

from sqlalchemy import CheckConstraint, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from service.storage.columns import new_id, word
from service.storage.models import JsonArray, JsonObject, Row, refers_to
from service.storage.words import ShapeState


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


class BoardShapeRow(Row):
    """The shape of a target as it was learnt from many runs; solves use the certified one.

    deviations, sd: by corner, x y z, m. run_ids: the runs it was learnt from. certainty: what its uncertainty
    does to cameras. drift: against the shape that was certified then, null for the first.
    """

    __tablename__ = "board_shape"
    __table_args__ = (
        UniqueConstraint("target_id", "version"),
        CheckConstraint("version >= 1", name="version_from_1"),
        CheckConstraint("state <> 'certified' OR certified_at IS NOT NULL", name="certified_has_time"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    target_id: Mapped[UUID] = mapped_column(refers_to("target.id"))
    version: Mapped[int]
    state: Mapped[ShapeState] = mapped_column(word(ShapeState, "state"), default=ShapeState.DRAFT)
    deviations: Mapped[JsonArray]
    sd: Mapped[JsonArray]
    run_ids: Mapped[JsonArray]
    bend_mm: Mapped[float]
    in_plane_mm: Mapped[float]
    sigma_flat_px: Mapped[float]
    sigma_px: Mapped[float]
    certainty: Mapped[JsonObject]
    drift: Mapped[JsonObject | None] = mapped_column(default=None)
    job_id: Mapped[UUID | None] = mapped_column(refers_to("job.id"), default=None)
    created_at: Mapped[datetime]
    created_by: Mapped[str]
    certified_at: Mapped[datetime | None] = mapped_column(default=None)
    certified_by: Mapped[str | None] = mapped_column(default=None)
    retired_at: Mapped[datetime | None] = mapped_column(default=None)
    retired_by: Mapped[str | None] = mapped_column(default=None)
