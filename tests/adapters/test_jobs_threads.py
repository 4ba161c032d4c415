"""Jobs: queued with the caller's transaction, done exactly once, resumed after a stop or a crash."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy.orm import Session

from service.adapters.clock_system import SystemClock
from service.adapters.jobs_threads import ThreadJobs
from service.core.errors import JobAlreadyEnded, NotFound, PoseSpaceEmpty
from service.ports import JobCompletion, JobRun, JsonObject
from service.storage import jobs
from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.models import SkuRow
from service.storage.words import JobState
from tests.adapters.queueing import HANDLERS, add_sku, add_sku_row, enqueue, job, queue_on, skus
from tests.fakes import START, FakeClock


def test_a_job_is_done_with_what_it_found_in_one_transaction(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "add-sku", code="lens1")

    assert queue.run_one()

    row = job(database, job_id)
    assert (row.state, row.progress, row.result) == (JobState.DONE, 1.0, {"code": "lens1"})
    assert (row.started_at, row.finished_at) == (START, START)
    assert skus(database) == 1
    assert not queue.run_one()


def test_a_job_of_a_transaction_that_was_undone_never_was(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)

    with pytest.raises(ZeroDivisionError):
        enqueue_and_fail(database, queue)

    assert not queue.run_one()


def enqueue_and_fail(database: Database, queue: ThreadJobs) -> None:
    with database.write() as session:
        queue.enqueue(session, "add-sku", {"code": "lens1"})
        raise ZeroDivisionError


def test_a_refused_job_fails_with_the_problem(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "refuse")

    queue.run_one()

    row = job(database, job_id)
    assert row.state is JobState.FAILED
    assert row.problem == {
        "code": "pose-space-empty",
        "title": PoseSpaceEmpty.title,
        "detail": "The pose space holds no pose. Widen its distances.",
        "facts": {"poses_found": 0},
    }


def test_a_crashed_job_fails_without_telling_its_inside(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "crash")

    queue.run_one()

    row = job(database, job_id)
    assert row.state is JobState.FAILED
    assert row.problem is not None
    assert "secret" not in str(row.problem)


def test_what_a_failed_completion_wrote_is_undone(database: Database, clock: FakeClock) -> None:
    def fail_late(_: JobRun) -> JobCompletion:
        def complete(session: Session) -> JsonObject:
            session.add(SkuRow(code="lens1", name="", created_at=START))
            session.flush()
            raise PoseSpaceEmpty("Widen the distances.")

        return complete

    queue = queue_on(database, clock, late=fail_late)
    job_id = enqueue(database, queue, "late")

    queue.run_one()

    assert job(database, job_id).state is JobState.FAILED
    assert skus(database) == 0


def test_a_queued_job_that_is_cancelled_never_runs(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "add-sku", code="lens1")

    with database.write() as session:
        queue.cancel(session, job_id)

    assert not queue.run_one()
    assert job(database, job_id).state is JobState.CANCELLED


@pytest.mark.parametrize("reports", [True, False], ids=["while it reports", "without a report"])
def test_a_running_job_that_is_cancelled_stores_nothing(
    database: Database, clock: FakeClock, reports: bool
) -> None:
    def cancelled_meanwhile(run: JobRun) -> JobCompletion:
        with database.write() as session:
            jobs.cancel(session, run.job_id, clock.now())
        return add_sku(run) if reports else add_sku_row

    queue = queue_on(database, clock, slow=cancelled_meanwhile)
    job_id = enqueue(database, queue, "slow", code="lens1")

    queue.run_one()

    assert job(database, job_id).state is JobState.CANCELLED
    assert skus(database) == 0


def test_only_jobs_that_have_not_ended_can_be_cancelled(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "add-sku", code="lens1")
    queue.run_one()

    with pytest.raises(JobAlreadyEnded), database.write() as session:
        queue.cancel(session, job_id)
    with pytest.raises(NotFound), database.write() as session:
        queue.cancel(session, new_id())


def test_progress_is_written_at_most_twice_a_second(database: Database, clock: FakeClock) -> None:
    seen: list[float] = []

    def report_often(run: JobRun) -> JobCompletion:
        for step in range(1000):
            run.report(step / 1000)
        seen.append(job(database, run.job_id).progress)
        return lambda _: {}

    queue = queue_on(database, clock, often=report_often)
    enqueue(database, queue, "often")
    begin = time.monotonic()
    queue.run_one()

    assert time.monotonic() - begin < 1.0
    assert 0.0 <= seen[0] < 1.0


def test_a_job_without_a_sign_of_life_is_taken_over_and_its_first_worker_stores_nothing(
    database: Database, clock: FakeClock
) -> None:
    def taken_over_meanwhile(run: JobRun) -> JobCompletion:
        clock.advance(31.0)
        other = queue_on(database, clock, frozen=add_sku)
        other.requeue_orphans(30.0)
        assert other.run_one()
        return add_sku_row

    queue = queue_on(database, clock, frozen=taken_over_meanwhile)
    job_id = enqueue(database, queue, "frozen", code="lens2")

    queue.run_one()

    assert job(database, job_id).result == {"code": "lens2"}
    assert skus(database) == 1


def test_a_clock_that_was_set_back_leaves_no_job_behind(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "add-sku", code="lens1")
    with database.write() as session:
        assert jobs.claim(session, new_id(), HANDLERS, clock.now()) is not None

    clock.advance(-3600.0)
    queue.requeue_orphans(30.0)

    assert job(database, job_id).state is JobState.QUEUED


def test_a_job_that_kills_its_workers_is_given_up(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "add-sku", code="lens1")
    for _ in range(jobs.MOST_ATTEMPTS):
        with database.write() as session:
            assert jobs.claim(session, new_id(), HANDLERS, clock.now()) is not None
        clock.advance(31.0)
        queue.requeue_orphans(30.0)

    row = job(database, job_id)
    assert (row.state, row.problem) == (JobState.FAILED, jobs.GIVEN_UP)


def test_a_job_that_lacked_something_is_tried_again(database: Database, clock: FakeClock) -> None:
    queue = queue_on(database, clock)
    job_id = enqueue(database, queue, "lack")

    queue.run_one()
    assert job(database, job_id).state is JobState.RUNNING
    clock.advance(31.0)
    queue.requeue_orphans(30.0)

    assert job(database, job_id).state is JobState.QUEUED


def test_many_workers_do_each_job_once(database: Database) -> None:
    workers = [ThreadJobs(database, SystemClock(), HANDLERS) for _ in range(4)]
    for number in range(24):
        enqueue(database, workers[0], "add-sku", code=f"lens{number}")

    def work_off(worker: ThreadJobs) -> int:
        done = 0
        while worker.run_one():
            done += 1
        return done

    with ThreadPoolExecutor(4) as threads:
        assert sum(threads.map(work_off, workers)) == 24
    assert skus(database) == 24


def test_jobs_of_unknown_kinds_are_left_to_those_who_know_them(database: Database, clock: FakeClock) -> None:
    job_id = enqueue(database, queue_on(database, clock), "from-the-future")

    assert not queue_on(database, clock).run_one()
    assert job(database, job_id).state is JobState.QUEUED
