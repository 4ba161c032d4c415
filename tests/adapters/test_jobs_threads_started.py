"""Worker threads: they start at once, show signs of life, end in order, and go on after trouble."""

import threading
import time
from datetime import datetime

import pytest

from service.adapters.clock_system import SystemClock
from service.adapters.jobs_threads import ThreadJobs
from service.core.errors import DatabaseBusy, Unavailable
from service.ports import JobCompletion, JobRun
from service.storage import jobs
from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.words import JobState
from tests.adapters.queueing import (
    HANDLERS,
    add_sku_row,
    enqueue,
    job,
    queue_on,
    skus,
    started,
    wait_for,
)
from tests.fakes import FakeClock


def test_a_job_starts_at_once_when_its_transaction_commits(database: Database) -> None:
    queue = ThreadJobs(database, SystemClock(), HANDLERS, poll_s=60.0)
    with started(queue):
        job_id = enqueue(database, queue, "add-sku", code="lens1")
        wait_for(lambda: job(database, job_id).state is JobState.DONE)


def test_a_job_whose_process_died_runs_again_at_the_next_start(
    sqlite_database: Database, clock: FakeClock
) -> None:
    died = queue_on(sqlite_database, clock)
    job_id = enqueue(sqlite_database, died, "add-sku", code="lens1")
    with sqlite_database.write() as session:
        assert jobs.claim(session, new_id(), HANDLERS, clock.now()) is not None

    with started(queue_on(sqlite_database, clock)):
        wait_for(lambda: job(sqlite_database, job_id).state is JobState.DONE)

    assert job(sqlite_database, job_id).attempts == 2
    assert skus(sqlite_database) == 1


def test_a_stop_lets_a_running_job_end(database: Database) -> None:
    begun = threading.Event()

    def slow(_: JobRun) -> JobCompletion:
        begun.set()
        time.sleep(0.3)
        return add_sku_row

    queue = ThreadJobs(database, SystemClock(), {"slow": slow})
    with started(queue):
        job_id = enqueue(database, queue, "slow")
        assert begun.wait(10)
        queue.stop(5.0)

    assert job(database, job_id).state is JobState.DONE


def test_a_job_that_does_not_end_in_time_goes_back_to_the_queue(database: Database) -> None:
    begun = threading.Event()

    def endless(run: JobRun) -> JobCompletion:
        begun.set()
        while True:
            run.report(0.1)
            time.sleep(0.02)

    queue = ThreadJobs(database, SystemClock(), {"endless": endless})
    with started(queue):
        job_id = enqueue(database, queue, "endless")
        assert begun.wait(10)
        queue.stop(0.1)

    row = job(database, job_id)
    assert (row.state, row.attempts, row.claimed_by) == (JobState.QUEUED, 0, None)


def test_a_long_job_that_reports_nothing_keeps_its_claim(database: Database) -> None:
    stale_s = 3.0  # long enough for a busy machine to come round in

    def silent(_: JobRun) -> JobCompletion:
        time.sleep(1.3 * stale_s)
        return add_sku_row

    queues = [ThreadJobs(database, SystemClock(), {"silent": silent}, stale_s=stale_s) for _ in range(2)]
    with started(queues[0]), started(queues[1]):
        job_id = enqueue(database, queues[0], "silent")
        wait_for(lambda: job(database, job_id).state is JobState.DONE)

    assert job(database, job_id).attempts == 1


class ClockThatFails(FakeClock):
    """Stands for anything that fails unexpectedly in a worker: it fails at its second call."""

    calls = 0

    def now(self) -> datetime:
        self.calls += 1
        if self.calls == 2:
            raise DatabaseBusy("Try again.")
        return super().now()


def test_a_worker_goes_on_after_the_queue_could_not_be_read(sqlite_database: Database) -> None:
    queue = ThreadJobs(sqlite_database, ClockThatFails(), HANDLERS, poll_s=0.05)
    with started(queue):
        time.sleep(0.1)
        job_id = enqueue(sqlite_database, queue, "add-sku", code="lens1")
        wait_for(lambda: job(sqlite_database, job_id).state is JobState.DONE)
        queue.check()


def test_a_queue_that_was_stopped_is_not_ready(sqlite_database: Database, clock: FakeClock) -> None:
    queue = queue_on(sqlite_database, clock)
    with started(queue):
        queue.check()

    with pytest.raises(Unavailable):
        queue.check()
