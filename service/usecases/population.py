"""The population of a SKU revision: which cameras make it up, their running sums, and what is shown of it.

A camera counts by its latest production or retest run with the verdict PASS. Results are judged by a state of
the population that is kept for ever, renewed whenever it has grown by a tenth: so a result can be computed
again, and no run shifts what the next one is judged by. Not here: the mathematics
(`core.quality.population`) and which states judge a run (`identity`).
"""

from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.quality.gates_identity import focal_off_share
from service.core.quality.limits import Limits
from service.core.quality.population import NEEDED_UNITS, Moments, Population, population_of, select_units
from service.core.vision.camera import Intrinsics, parameter_names
from service.core.vision.transforms import Array
from service.storage.learnt import PopulationMomentsRow, PopulationRow, PopulationUnitRow
from service.storage.models import CalibrationRow, RunRow, SkuRevisionRow
from service.storage.words import Publication
from service.usecases.run_filter import COUNTED_PURPOSES
from service.usecases.sku_document import Revision, SkuDocument
from service.usecases.skus import get_revision, get_sku

GROWTH = 10  # a new state judges once there is a tenth more units


@dataclass(frozen=True)
class ParameterView:
    """A parameter over the cameras: mean, sd between cameras and of one calibration, and the nominal."""

    name: str
    mean: float
    sd_between: float
    sd_own: float
    nominal: float


@dataclass(frozen=True)
class PopulationView:
    """What the cameras of a SKU revision have in common; `parameters` are there from two units on.

    start_limits_used: the largest share of the start limits on focal length and centre that the mean with
    three standard deviations takes. judged_by: units of the state that judges results now.
    """

    sku: str
    revision: int
    units: int
    needed: int
    judged_by: int | None
    judged_since: datetime | None
    start_limits_used: float | None
    parameters: list[ParameterView]
    covariance: list[list[float]] | None


def admit_unit(session: Session, run: RunRow, calibration: CalibrationRow, now: datetime) -> None:
    """Count a finished run's camera, in the place of an earlier run of its serial.

    Only those with the verdict PASS count.
    """
    if run.purpose not in COUNTED_PURPOSES or calibration.verdict is not Verdict.PASS:
        return
    revision_id = run.sku_revision_id
    # Whoever finishes another run of the revision at the same moment waits here.
    session.get(SkuRevisionRow, revision_id, with_for_update={"key_share": True})
    moments = read_moments(session, revision_id) or Moments.of_none(len(calibration.covariance))
    unit = session.get(PopulationUnitRow, (revision_id, run.serial))
    if unit is None:
        unit = PopulationUnitRow(sku_revision_id=revision_id, serial=run.serial, run_id=run.id)
        session.add(unit)
    elif unit.is_counted:
        moments = moments.without_unit(*_estimate_of(session, unit.run_id))
    unit.run_id, unit.is_counted = run.id, True
    moments = moments.with_unit(*_estimate(calibration))
    session.flush()
    _bring_into_force(session, revision_id, moments, now)


def read_moments(session: Session, revision_id: UUID) -> Moments | None:
    """Return the running sums of a revision; None before its first unit."""
    row = session.get(PopulationMomentsRow, revision_id)
    if row is None:
        return None
    return Moments(row.units, np.array(row.mean), np.array(row.scatter), np.array(row.own))


def latest_population(session: Session, revision_id: UUID) -> PopulationRow | None:
    """Return the state of a revision's population that judges results now; None before it is large enough."""
    query = select(PopulationRow).where(PopulationRow.sku_revision_id == revision_id)
    return session.scalar(query.order_by(PopulationRow.units.desc()).limit(1))


def to_population(row: PopulationRow) -> Population:
    """Return a stored state as the core's value."""
    return Population(row.units, np.array(row.mean), np.array(row.between))


def read_population(session: Session, code: str, number: int | None = None) -> PopulationView:
    """Return the population of a revision, by default of the published one, else of the newest.

    Raises NotFound.
    """
    row = _revision_row(session, code, number)
    revision = SkuDocument.model_validate(row.document).to_revision()
    moments = read_moments(session, row.id)
    judging = latest_population(session, row.id)
    known = None if moments is None or moments.units < 2 else population_of(moments)
    return PopulationView(
        sku=code,
        revision=row.number,
        units=0 if moments is None else moments.units,
        needed=NEEDED_UNITS,
        judged_by=None if judging is None else judging.units,
        judged_since=None if judging is None else judging.created_at,
        start_limits_used=None if known is None else _start_limits_used(known, revision),
        parameters=[] if known is None or moments is None else _parameters(known, moments, revision),
        covariance=None if known is None else known.between.tolist(),
    )


def _bring_into_force(session: Session, revision_id: UUID, moments: Moments, now: datetime) -> None:
    """Store the sums, and a state that results are judged by where there is none or it has grown enough."""
    judging = latest_population(session, revision_id)
    if judging is None and moments.units >= NEEDED_UNITS:
        moments = _without_strays(session, revision_id, moments)
    _store_moments(session, revision_id, moments, now)
    needed = NEEDED_UNITS if judging is None else judging.units + judging.units // GROWTH
    if moments.units >= needed:
        population = population_of(moments)
        session.add(
            PopulationRow(
                sku_revision_id=revision_id,
                units=population.units,
                mean=population.mean.tolist(),
                between=population.between.tolist(),
                created_at=now,
            )
        )


def _without_strays(session: Session, revision_id: UUID, moments: Moments) -> Moments:
    """Leave out of the first units those that no gate could see yet: they lie apart from the others."""
    query = select(PopulationUnitRow).where(PopulationUnitRow.sku_revision_id == revision_id)
    units = [unit for unit in session.scalars(query.order_by(PopulationUnitRow.serial)) if unit.is_counted]
    found = [_estimate_of(session, unit.run_id) for unit in units]
    kept = select_units([v for v, _ in found], [c for _, c in found], Limits().population_distance)
    for unit, estimate, is_kept in zip(units, found, kept, strict=True):
        if not is_kept:
            unit.is_counted = False
            moments = moments.without_unit(*estimate)
    return moments


def _store_moments(session: Session, revision_id: UUID, moments: Moments, now: datetime) -> None:
    session.merge(
        PopulationMomentsRow(
            sku_revision_id=revision_id,
            units=moments.units,
            mean=moments.mean.tolist(),
            scatter=moments.scatter.tolist(),
            own=moments.own.tolist(),
            updated_at=now,
        )
    )


def _estimate_of(session: Session, run_id: UUID) -> tuple[Array, Array]:
    return _estimate(session.scalars(select(CalibrationRow).where(CalibrationRow.run_id == run_id)).one())


def _estimate(calibration: CalibrationRow) -> tuple[Array, Array]:
    """Return the parameters (p,) of a result and their covariance (p, p)."""
    names = parameter_names(calibration.lens)
    return np.array([calibration.intrinsics[name] for name in names]), np.array(calibration.covariance)


def _revision_row(session: Session, code: str, number: int | None) -> SkuRevisionRow:
    if number is not None:
        return get_revision(session, code, number)
    query = select(SkuRevisionRow).where(SkuRevisionRow.sku_id == get_sku(session, code).id)
    rows = list(session.scalars(query.order_by(SkuRevisionRow.number.desc())))
    return next((row for row in rows if row.state is Publication.PUBLISHED), rows[0])


def _start_limits_used(population: Population, revision: Revision) -> float:
    """Return how much of the start limits the mean with three standard deviations takes."""
    nominal, limits = revision.intrinsics, revision.limits
    three_sd = 3.0 * np.sqrt(np.diagonal(population.between))
    mean = Intrinsics.from_vector(nominal.lens, population.mean, nominal.image_size)
    focal = focal_off_share(mean, nominal) + float((three_sd[:2] / nominal.vector[:2]).max())
    centre = float((np.abs(population.mean - nominal.vector) + three_sd)[2:4].max())
    return max(focal / limits.focal_off_share, centre / limits.centre_off_px)


def _parameters(population: Population, moments: Moments, revision: Revision) -> list[ParameterView]:
    nominal = revision.intrinsics
    between = np.sqrt(np.diagonal(population.between))
    own = np.sqrt(np.maximum(np.diagonal(moments.own), 0.0) / moments.units)
    return [
        ParameterView(name, float(mean), float(sd), float(noise), float(given))
        for name, mean, sd, noise, given in zip(
            parameter_names(nominal.lens), population.mean, between, own, nominal.vector, strict=True
        )
    ]
