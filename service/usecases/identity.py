"""By what a run's camera is told from others: its SKU's population, and other SKUs with theirs.

What judged a result is written down with it, by ids of rows that never change: computed again, the result is
judged by the same, however many cameras and SKUs have come since. Not here: the population itself
(`population`) and the gate (`core.quality`).
"""

from dataclasses import dataclass, field
from typing import Any
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.population import Population
from service.core.vision.camera import Intrinsics
from service.storage.learnt import PopulationRow
from service.storage.models import CalibrationRow, RunRow, SkuRevisionRow, SkuRow
from service.storage.words import Publication
from service.usecases.population import latest_population, read_moments, to_population
from service.usecases.sku_document import SkuDocument

JsonObject = dict[str, Any]


@dataclass(frozen=True)
class Identity:
    """What judges the identity of a run's camera; `reference` is the form that is stored with the result.

    reference: None for results of before, which did not write it down.
    """

    reference: JsonObject | None
    units: int | None
    population: Population | None
    other_skus: dict[str, Intrinsics] = field(default_factory=dict)
    other_populations: dict[str, Population] = field(default_factory=dict)


def load_identity(session: Session, run: RunRow) -> Identity:
    """Return what judges a run: what judged its result where it has one, else what stands now."""
    document = session.scalar(select(CalibrationRow.document).where(CalibrationRow.run_id == run.id))
    if document is None:
        return _resolve(session, _present_reference(session, run))
    stored: JsonObject | None = document.get("identity")
    if stored is not None:
        return _resolve(session, stored)
    others = _resolve(session, _present_reference(session, run)).other_skus
    return Identity(None, None, None, others)


def _present_reference(session: Session, run: RunRow) -> JsonObject:
    """Name what stands now: the population, and published revisions of SKUs of this lens and image size."""
    own = session.get_one(SkuRevisionRow, run.sku_revision_id)
    moments, population = read_moments(session, own.id), latest_population(session, own.id)
    query = (
        select(SkuRow.code, SkuRevisionRow)
        .join(SkuRevisionRow, SkuRevisionRow.sku_id == SkuRow.id)
        .where(SkuRevisionRow.state == Publication.PUBLISHED, SkuRow.id != own.sku_id)
        .order_by(SkuRow.code)
    )
    kind = _kind(own.document)
    return {
        "units": 0 if moments is None else moments.units,
        "population": None if population is None else str(population.id),
        "others": {
            code: _name(session, revision)
            for code, revision in session.execute(query)
            if _kind(revision.document) == kind
        },
    }


def _name(session: Session, revision: SkuRevisionRow) -> JsonObject:
    population = latest_population(session, revision.id)
    return {"revision": str(revision.id), "population": None if population is None else str(population.id)}


def _kind(document: JsonObject) -> tuple[str, list[int]]:
    return document["lens"], list(document["image_size"])


def _resolve(session: Session, reference: JsonObject) -> Identity:
    others = reference["others"]
    populations = {code: _population(session, other["population"]) for code, other in others.items()}
    return Identity(
        reference,
        reference["units"],
        _population(session, reference["population"]),
        {code: _nominal(session, other["revision"]) for code, other in others.items()},
        {code: population for code, population in populations.items() if population is not None},
    )


def _population(session: Session, population_id: str | None) -> Population | None:
    return (
        None if population_id is None else to_population(session.get_one(PopulationRow, UUID(population_id)))
    )


def _nominal(session: Session, revision_id: str) -> Intrinsics:
    document = session.get_one(SkuRevisionRow, UUID(revision_id)).document
    return SkuDocument.model_validate(document).to_revision().intrinsics
