"""Jobs to queue in tests, and what became of them."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from uuid import UUID

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from service.adapters.jobs_threads import ThreadJobs
from service.core.errors import DatabaseBusy, PoseSpaceEmpty
from service.ports import JobCompletion, JobHandler, JobRun, JsonObject
from service.storage.database import Database
from service.storage.models import JobRow, SkuRow
from tests.fakes import START, FakeClock


def add_sku(run: JobRun) -> JobCompletion:
    def complete(session: Session) -> JsonObject:
        session.add(SkuRow(code=str(run.arguments["code"]), name="", created_at=START))
        return {"code": run.arguments["code"]}

    run.report(0.5)
    return complete


def refuse(_: JobRun) -> JobCompletion:
    raise PoseSpaceEmpty("The pose space holds no pose. Widen its distances.", poses_found=0)


def crash(_: JobRun) -> JobCompletion:
    raise ZeroDivisionError("secret detail")


def lack(_: JobRun) -> JobCompletion:
    raise DatabaseBusy("Try again.")


HANDLERS: dict[str, JobHandler] = {"add-sku": add_sku, "refuse": refuse, "crash": crash, "lack": lack}


def queue_on(database: Database, clock: FakeClock, **handlers: JobHandler) -> ThreadJobs:
    return ThreadJobs(database, clock, {**HANDLERS, **handlers})


def enqueue(database: Database, queue: ThreadJobs, kind: str, **arguments: object) -> UUID:
    with database.write() as session:
        return queue.enqueue(session, kind, arguments)


def job(database: Database, job_id: UUID) -> JobRow:
    with database.read() as session:
        row = session.get(JobRow, job_id)
        assert row is not None
        return row


def skus(database: Database) -> int:
    with database.read() as session:
        return session.scalar(select(func.count()).select_from(SkuRow)) or 0


def wait_for(condition: Callable[[], bool], timeout_s: float = 10.0) -> None:
    end = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.01)


@contextmanager
def started(queue: ThreadJobs) -> Iterator[ThreadJobs]:
    queue.start()
    try:
        yield queue
    finally:
        queue.stop(5.0)


def add_sku_row(session: Session) -> JsonObject:
    session.add(SkuRow(code="lens1", name="", created_at=START))
    return {}
