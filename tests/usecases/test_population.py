"""The population of a SKU revision as runs come and go, and the results that it judges."""

from collections.abc import Iterator
from datetime import timedelta
from uuid import UUID

import numpy as np
import pytest
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.quality.population import Moments
from service.core.run import Outcome, Purpose, RunState
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array
from service.storage.learnt import PopulationRow, PopulationUnitRow
from service.storage.models import CalibrationRow, MeasurementRow, RunRow, SkuRevisionRow
from service.usecases.calibration_input import calibrate, load_input
from service.usecases.finish import recompute
from service.usecases.population import admit_unit, latest_population, read_moments
from service.usecases.runs import get_run
from tests.fakes import START
from tests.plant import Plant, problem, revision

# As large as the tiny camera's calibrations make it.
NOISE = np.diag(np.r_[0.012, 0.012, 0.02, 0.02, 2e-4, 1e-3, 2e-5, 2e-5, 2e-3] ** 2)
SPREAD = Tolerance(coefficients={"k1": 0.005, "k2": 0.01, "p1": 3e-4, "p2": 3e-4, "k3": 0.01})


def units(count: int, seed: int = 1) -> Iterator[Array]:
    """Return what calibrations of other cameras of the SKU found."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield draw_camera(revision().intrinsics, SPREAD, rng).vector + np.sqrt(
            np.diagonal(NOISE)
        ) * rng.normal(size=9)


def add_run(
    session: Session,
    serial: str,
    vector: Array,
    *,
    verdict: Verdict = Verdict.PASS,
    purpose: Purpose = Purpose.PRODUCTION,
) -> None:
    """Add a finished run with its result, as finishing it does."""
    revision_id = session.scalars(select(SkuRevisionRow.id)).one()
    run = RunRow(
        sku_revision_id=revision_id,
        serial=serial,
        purpose=purpose,
        state=RunState.FINISHED,
        verdict=verdict,
        outcome=Outcome.COMPLETED,
        created_by="test",
        created_at=START,
        finished_at=START,
    )
    names = revision().intrinsics.parameters
    calibration = CalibrationRow(
        run_id=run.id,
        verdict=verdict,
        lens="pinhole5",
        intrinsics=dict(zip(names, map(float, vector), strict=True)),
        covariance=NOISE.tolist(),
        rms_px=0.1,
        sigma_px=0.1,
        document={},
        versions={},
        created_at=START,
    )
    session.add_all([run, calibration])
    session.flush()
    admit_unit(session, run, calibration, START + timedelta(minutes=1))


def revision_id(session: Session) -> UUID:
    return session.scalars(select(SkuRevisionRow.id)).one()


def moments(session: Session) -> Moments:
    found = read_moments(session, revision_id(session))
    assert found is not None
    return found


@pytest.fixture
def line(plant: Plant) -> Plant:
    """A plant whose SKU is published."""
    plant.publish_sku()
    return plant


def test_a_camera_counts_once_by_its_latest_pass(line: Plant) -> None:
    first, again, other = units(3)
    with line.app.state.services.database.write() as session:
        add_run(session, "A", first)
        add_run(session, "B", other)
        add_run(session, "A", again, purpose=Purpose.RETEST)
        add_run(session, "A", first * 1.01, verdict=Verdict.FAIL)
        add_run(session, "A", first * 1.01, verdict=Verdict.MARGINAL)
        add_run(session, "C", first * 1.01, purpose=Purpose.SIMULATED)
        wanted = Moments.of_none(9).with_unit(other, NOISE).with_unit(again, NOISE)

        found = moments(session)

        assert found.units == 2
        assert np.allclose(found.mean, wanted.mean, rtol=1e-12)
        assert np.allclose(found.scatter, wanted.scatter, rtol=1e-7, atol=1e-14)


def test_a_stray_among_the_first_fifty_is_not_counted(small_plant: Plant) -> None:
    small_plant.publish_sku()
    with small_plant.app.state.services.database.write() as session:
        for i, unit in enumerate(units(50)):
            add_run(session, f"U{i:02d}", unit + (i == 20) * np.r_[0, 0, 24.0, np.zeros(6)])
        assert latest_population(session, revision_id(session)) is None
        strays = session.scalars(select(PopulationUnitRow).where(~PopulationUnitRow.is_counted)).all()
        assert [one.serial for one in strays] == ["U20"]
        assert moments(session).units == 49

        (more,) = units(1, seed=2)
        add_run(session, "U50", more)

        population = latest_population(session, revision_id(session))
        assert population is not None
        assert population.units == 50


def test_a_result_is_judged_by_the_population_and_again_by_the_same(line: Plant) -> None:
    database = line.app.state.services.database
    with database.write() as session:
        for i, unit in enumerate(units(60)):
            add_run(session, f"U{i:02d}", unit)
        states = session.scalars(select(PopulationRow.units).order_by(PopulationRow.units)).all()
        assert states == [50, 55, 60]

    run_id = UUID(line.finished_run("VIN-60"))

    with database.write() as session:
        stored = session.scalars(select(CalibrationRow).where(CalibrationRow.run_id == run_id)).one()
        query = select(MeasurementRow).where(MeasurementRow.calibration_id == stored.id)
        found = {row.name: row for row in session.scalars(query.order_by(MeasurementRow.id))}
        assert found["population_distance"].verdict is Verdict.PASS
        assert found["population_distance"].facts["units"] == 60
        for i, unit in enumerate(units(30, seed=3)):
            add_run(session, f"W{i:02d}", unit)
        newer = latest_population(session, revision_id(session))
        assert newer is not None
        assert newer.units > 60

        again = recompute(session, run_id)
        judged = calibrate(load_input(session, get_run(session, run_id)))

        assert again == stored.document
        assert [(m.name, m.value, m.margin, m.verdict, m.facts or None) for m in judged.measurements] == [
            (row.name, row.value, row.margin, row.verdict, row.facts) for row in found.values()
        ]


def test_the_population_is_read(small_plant: Plant) -> None:
    small_plant.publish_sku()
    empty = small_plant.expect(200, small_plant.get("/skus/tiny/population"))
    assert (empty["units"], empty["needed"], empty["judged_by"], empty["parameters"]) == (0, 50, None, [])

    with small_plant.app.state.services.database.write() as session:
        for i, unit in enumerate(units(60)):
            add_run(session, f"U{i:02d}", unit)
    found = small_plant.expect(200, small_plant.get("/skus/tiny/population?revision=1"))

    assert (found["sku"], found["revision"], found["units"], found["judged_by"]) == ("tiny", 1, 60, 60)
    centre = next(one for one in found["parameters"] if one["name"] == "cx")
    assert centre["nominal"] == revision().intrinsics.parameters["cx"]
    assert 1.8 < centre["sd_between"] < 2.8  # of an even spread of 4 px to either side: 2.3
    assert abs(centre["sd_own"] - 0.02) < 1e-9
    assert 0.2 < found["start_limits_used"] < 0.9
    assert len(found["covariance"]) == len(found["parameters"]) == 9
    problem(small_plant.get("/skus/none/population"), 404, "not-found")
    problem(small_plant.get("/skus/tiny/population?revision=7"), 404, "not-found")
