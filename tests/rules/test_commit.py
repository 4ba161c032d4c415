"""A request's transaction is committed before its answer: where the commit fails, no success is answered."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from sqlalchemy import event, select
from sqlalchemy.orm import Session

from service.core.errors import DiskFull
from service.storage.models import CalibrationRow, CaptureRow, RunRow
from service.storage.words import Role
from tests.plant import SKU, Plant, pose_set, problem


@contextmanager
def failing_commits(plant: Plant, error: Exception) -> Iterator[None]:
    """Let every commit of the writing connection fail, as on a full disk."""

    def fail(_connection: object) -> None:
        raise error

    engine = plant.app.state.services.database.writer
    event.listen(engine, "commit", fail)
    try:
        yield
    finally:
        event.remove(engine, "commit", fail)


@pytest.mark.parametrize(
    ("error", "status", "code"),
    [
        (RuntimeError("secret inside"), 500, "internal-error"),
        (DiskFull("No room left on it."), 503, "disk-full"),
    ],
)
def test_a_failing_commit_is_never_a_success(plant: Plant, error: Exception, status: int, code: str) -> None:
    with failing_commits(plant, error):
        refused = plant.post("/skus", SKU)

    problem(refused, status, code)
    assert "secret" not in refused.text
    assert plant.get("/skus").json()["items"] == []
    assert plant.post("/skus", SKU).status_code == 201


def test_a_capture_whose_commit_fails_is_not_acknowledged(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()

    with failing_commits(plant, DiskFull("No room left on it.")):
        problem(plant.upload(run_id, 0), 503, "disk-full")

    assert count(plant, CaptureRow) == 0
    assert plant.upload(run_id, 0).status_code == 201


def test_a_verdict_whose_commit_fails_is_not_told(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    for index in range(len(pose_set().poses)):
        plant.upload(run_id, index)

    with failing_commits(plant, DiskFull("No room left on it.")):
        problem(plant.finish(run_id), 503, "disk-full")

    assert count(plant, CalibrationRow) == 0
    assert plant.get(f"/runs/{run_id}").json()["verdict"] is None
    assert plant.finish(run_id).json()["verdict"] == "PASS"


def test_an_answer_that_cannot_be_remembered_opens_no_run(plant: Plant) -> None:
    plant.publish_sku()
    body, key = {"sku": "tiny", "serial": "A"}, {"Idempotency-Key": "k"}

    with failing_commits(plant, DiskFull("No room left on it.")):
        problem(plant.post("/runs", body, role=Role.MES, headers=key), 503, "disk-full")

    assert count(plant, RunRow) == 0


def count(plant: Plant, row: type) -> int:
    """How many rows there are."""
    with plant.app.state.services.database.read() as session:
        return len(_all(session, row))


def _all(session: Session, row: type) -> list[object]:
    return list(session.scalars(select(row)))
