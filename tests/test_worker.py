"""The worker as a process: works off jobs of PostgreSQL, goes on after a kill, stops on SIGTERM."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from service.adapters.clock_system import SystemClock
from service.storage import jobs
from service.storage.database import Database
from service.storage.models import JobRow
from service.storage.words import JobState
from service.usecases.planning import PLAN_POSE_SET

ROOT = Path(__file__).resolve().parents[1]


@contextmanager
def worker(address: str, *, stale_s: float = 30.0) -> Iterator[subprocess.Popen[str]]:
    environment = os.environ | {
        "DMSCAL_DATABASE_URL": address,
        "DMSCAL_JOBS__POLL_S": "0.05",
        "DMSCAL_JOBS__STALE_S": str(stale_s),
    }
    command = [sys.executable, "-m", "service.worker"]
    with subprocess.Popen(  # noqa: S603 - our own command
        command, cwd=ROOT, env=environment, stderr=subprocess.PIPE, text=True
    ) as process:
        yield process
        process.kill()


def wait_for(condition: Callable[[], bool], timeout_s: float = 60.0) -> None:
    end = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.05)


def enqueue_unknown_pose_set(database: Database) -> JobRow:
    with database.write() as session:
        job_id = jobs.enqueue(
            session,
            PLAN_POSE_SET,
            {"pose_set_id": "019a0000-0000-7000-8000-000000000000"},
            SystemClock().now(),
        )
        return session.get_one(JobRow, job_id)


def state(database: Database, row: JobRow) -> JobState:
    with database.read() as session:
        return session.get_one(JobRow, row.id).state


@pytest.mark.postgresql
def test_a_worker_works_off_jobs_until_it_is_told_to_stop(
    postgresql_database: Database, postgresql_address: str
) -> None:
    with worker(postgresql_address) as process:
        row = enqueue_unknown_pose_set(postgresql_database)
        wait_for(lambda: state(postgresql_database, row) is JobState.FAILED)

        process.send_signal(signal.SIGTERM)

        assert process.wait(30) == 0
        assert process.stderr is not None
        assert "stopped" in process.stderr.read()


@pytest.mark.postgresql
def test_a_job_of_a_worker_that_died_is_taken_over(
    postgresql_database: Database, postgresql_address: str
) -> None:
    row = enqueue_unknown_pose_set(postgresql_database)
    with postgresql_database.write() as session:
        assert jobs.claim(session, row.id, [PLAN_POSE_SET], SystemClock().now()) is not None
    assert state(postgresql_database, row) is JobState.RUNNING

    with worker(postgresql_address, stale_s=1.0):
        wait_for(lambda: state(postgresql_database, row) is JobState.FAILED)


def test_a_worker_on_sqlite_says_that_the_service_runs_the_jobs(sqlite_address: str) -> None:
    with worker(sqlite_address) as process:
        assert process.wait(60) == 2
        assert process.stderr is not None
        assert "the service runs the jobs itself" in process.stderr.read()
