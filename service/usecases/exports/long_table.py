"""Results as a long table, for CSV and Parquet: a row for every parameter, figure and measurement."""

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime

from service.core.vision.camera import PINHOLE
from service.storage.models import MeasurementRow
from service.usecases.finished_run import RunFacts


@dataclass(frozen=True)
class Row:
    """One row; the fields are the columns. kind: `parameter`, `figure` or `measurement`.

    verdict is the run's, measured_verdict the measurement's.
    """

    run_id: str
    serial: str
    sku: str
    revision: int
    station: str | None
    purpose: str
    finished_at: datetime
    verdict: str
    lens: str
    kind: str
    gate: str | None
    name: str
    value: float | None
    sd: float | None
    unit: str
    comparison: str | None
    limit: float | None
    margin: float | None
    measured_verdict: str | None


def rows_of(facts: RunFacts) -> Iterator[Row]:
    """Yield the rows of a run: its parameters, then its figures, then its measurements."""
    sd = facts.sd
    for name, value in facts.intrinsics.parameters.items():
        yield _row(facts, "parameter", name, value, "px" if name in PINHOLE else "", sd=sd[name])
    yield _row(facts, "figure", "rms_px", facts.rms_px, "px")
    yield _row(facts, "figure", "sigma_px", facts.sigma_px, "px")
    for measurement in facts.measurements:
        yield _row(
            facts, "measurement", measurement.name, measurement.value, measurement.unit, measured=measurement
        )


def _row(
    facts: RunFacts,
    kind: str,
    name: str,
    value: float | None,
    unit: str,
    *,
    sd: float | None = None,
    measured: MeasurementRow | None = None,
) -> Row:
    return Row(
        run_id=str(facts.run_id),
        serial=facts.serial,
        sku=facts.sku,
        revision=facts.revision,
        station=facts.station,
        purpose=facts.purpose.value,
        finished_at=facts.finished_at,
        verdict=facts.verdict.value,
        lens=facts.intrinsics.lens,
        kind=kind,
        gate=None if measured is None else measured.gate,
        name=name,
        value=value,
        sd=sd,
        unit=unit,
        comparison=None if measured is None or measured.limit is None else measured.comparison,
        limit=None if measured is None else measured.limit,
        margin=None if measured is None else measured.margin,
        measured_verdict=None if measured is None else measured.verdict.value,
    )
