"""Refusals of the database are errors of the domain, the same on both engines."""

import psycopg
import pytest
from sqlalchemy import select, text
from sqlalchemy.exc import IntegrityError

from service.core.errors import (
    AlreadyExists,
    DatabaseBusy,
    DatabaseUnreachable,
    DiskFull,
    DuplicateImage,
    RunAlreadyFinished,
    ServiceError,
)
from service.core.quality.gates import Verdict
from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.failures import CONSTRAINT_TO_ERROR, DETAILS, SQLITE_CODES, SQLSTATES, domain_error
from service.storage.models import (
    CalibrationRow,
    IdempotencyKeyRow,
    Row,
    RunRow,
    SkuRevisionRow,
    SkuRow,
    StationRow,
    TargetRow,
)
from tests.fakes import START
from tests.storage.make import make_capture, make_run


def sku(code: str = "lens1") -> SkuRow:
    return SkuRow(code=code, name="Lens", created_at=START)


def calibration(run: RunRow) -> CalibrationRow:
    return CalibrationRow(
        run_id=run.id,
        verdict=Verdict.PASS,
        lens="pinhole5",
        intrinsics={},
        covariance=[],
        rms_px=0.1,
        sigma_px=0.1,
        document={},
        versions={},
        created_at=START,
    )


def test_every_constraint_with_an_error_exists() -> None:
    names = {key.name for table in Row.metadata.tables.values() for key in table.constraints}

    assert set(CONSTRAINT_TO_ERROR) <= names


def test_every_kind_of_unavailability_says_what_to_do() -> None:
    assert set(DETAILS) == {*SQLITE_CODES.values(), *SQLSTATES.values()}


@pytest.mark.parametrize(
    "make",
    [
        sku,
        lambda: StationRow(code="st1", name="Station", created_at=START),
        lambda: TargetRow(serial="T1", spec="chessboard:9x6:25mm", created_at=START),
    ],
    ids=["sku", "station", "target"],
)
def test_a_name_that_is_taken_already_exists(database: Database, make: object) -> None:
    assert callable(make)
    with database.write() as session:
        session.add(make())

    with pytest.raises(AlreadyExists), database.write() as session:
        session.add(make())


def test_the_same_image_twice_in_a_run_is_a_duplicate(database: Database) -> None:
    with database.write() as session:
        run = make_run(session)
        session.add(make_capture(run, number=1, sha256="a" * 64))

    with pytest.raises(DuplicateImage), database.write() as session:
        session.add(make_capture(run, number=2, sha256="a" * 64))


def test_a_second_result_of_a_run_is_refused_because_the_first_stands(database: Database) -> None:
    with database.write() as session:
        run = make_run(session)
        session.add(calibration(run))

    with pytest.raises(RunAlreadyFinished), database.write() as session:
        session.add(calibration(run))


def test_an_idempotency_key_is_taken_once(database: Database) -> None:
    def take() -> None:
        with database.write() as session:
            session.add(IdempotencyKeyRow(key="k", principal="p", fingerprint="f", created_at=START))

    take()
    with pytest.raises(AlreadyExists):
        take()


@pytest.mark.postgresql
def test_a_postgresql_that_ends_a_session_is_unreachable_and_then_back(
    postgresql_database: Database,
) -> None:
    with pytest.raises(DatabaseUnreachable):
        write_while_the_session_is_ended(postgresql_database)

    with postgresql_database.write() as session:
        assert session.scalars(select(SkuRow)).all() == []
        session.add(sku())


def write_while_the_session_is_ended(database: Database) -> None:
    with database.write() as session:
        session.add(sku())
        session.flush()
        own = session.scalar(text("SELECT pg_backend_pid()"))
        with database.write() as other:
            other.execute(text("SELECT pg_terminate_backend(:own)"), {"own": own})
        session.execute(text("SELECT 1"))


@pytest.mark.parametrize(
    ("refusal", "error"),
    [
        (psycopg.errors.DeadlockDetected(), DatabaseBusy),
        (psycopg.errors.LockNotAvailable(), DatabaseBusy),
        (psycopg.errors.DiskFull(), DiskFull),
        (psycopg.errors.AdminShutdown(), DatabaseUnreachable),
        (psycopg.OperationalError("connection refused"), DatabaseUnreachable),
    ],
)
def test_what_postgresql_lacks_is_told(refusal: Exception, error: type[ServiceError]) -> None:
    assert type(domain_error(refusal)) is error


def test_a_statements_values_are_not_repeated_into_the_log(sqlite_database: Database) -> None:
    with pytest.raises(IntegrityError) as raised, sqlite_database.write() as session:
        session.add(SkuRevisionRow(sku_id=new_id(), number=0, document={"key": "secret"}, created_at=START))

    assert "secret" not in str(raised.value)


def test_a_fault_of_the_service_stays_the_drivers_error() -> None:
    assert domain_error(psycopg.errors.UndefinedColumn()) is None
    assert domain_error(ValueError()) is None
