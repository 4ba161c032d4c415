"""The table of jobs as a queue: each step is part of the caller's transaction and safe among many workers.

A worker that claims a job shows a sign of life now and then. A job whose worker shows none is queued again, a
few times: one that takes its worker down with it must not do so for ever. What a worker may still say about a
job depends on its claim, so a worker that was thought dead cannot overwrite what another one found.
"""

from collections.abc import Collection
from datetime import datetime, timedelta
from typing import Any
from uuid import UUID

from sqlalchemy import Update, or_, select, update
from sqlalchemy.orm import Session

from service.core.errors import JobAlreadyEnded, NotFound
from service.storage.models import JobRow, JsonObject
from service.storage.words import JobState

MOST_ATTEMPTS = 3
ENDED = (JobState.DONE, JobState.FAILED, JobState.CANCELLED)
GIVEN_UP: JsonObject = {
    "code": "job-abandoned",
    "title": "The job was given up",
    "detail": f"It was interrupted {MOST_ATTEMPTS} times. Read the worker's log, then queue the job again.",
}


def enqueue(session: Session, kind: str, arguments: JsonObject, now: datetime) -> UUID:
    """Queue a job and return its id; it exists once the transaction commits."""
    row = JobRow(kind=kind, arguments=arguments, created_at=now)
    session.add(row)
    session.flush()
    return row.id


def cancel(session: Session, job_id: UUID, now: datetime) -> None:
    """Cancel a job that has not ended; its worker, if any, notices at its next report."""
    row = session.scalar(select(JobRow).where(JobRow.id == job_id).with_for_update())
    if row is None:
        raise NotFound("There is no job of this id.", job_id=str(job_id))
    if row.state in ENDED:
        raise JobAlreadyEnded(f"The job is {row.state}; there is nothing to cancel.", state=str(row.state))
    row.state, row.finished_at = JobState.CANCELLED, now
    session.flush()


def claim(session: Session, worker: UUID, kinds: Collection[str], now: datetime) -> JobRow | None:
    """Take the oldest queued job of one of these kinds, or return None; no two workers get the same one."""
    row = session.scalar(
        select(JobRow)
        .where(JobRow.state == JobState.QUEUED, JobRow.kind.in_(kinds))
        .order_by(JobRow.created_at, JobRow.id)
        .limit(1)
        .with_for_update(skip_locked=True)
    )
    if row is not None:
        row.state, row.claimed_by, row.attempts = JobState.RUNNING, worker, row.attempts + 1
        row.started_at = row.heartbeat_at = now
    return row


def report(
    session: Session, job_id: UUID, worker: UUID, now: datetime, progress: float | None = None
) -> bool:
    """Show a sign of life, and progress if given; False when the job is no longer this worker's."""
    values: dict[str, Any] = {"heartbeat_at": now}
    if progress is not None:
        values["progress"] = progress
    return _update(session, _claimed(job_id, worker).values(values))


def finish(session: Session, job_id: UUID, worker: UUID, now: datetime, result: JsonObject) -> bool:
    """Mark a job done; False when it is no longer this worker's: then nothing it found may be stored."""
    ended = {"state": JobState.DONE, "progress": 1.0, "result": result, "finished_at": now}
    return _update(session, _claimed(job_id, worker).values(ended))


def fail(session: Session, job_id: UUID, worker: UUID, now: datetime, problem: JsonObject) -> bool:
    """Mark a job failed, with the problem to show; False when it is no longer this worker's."""
    ended = {"state": JobState.FAILED, "problem": problem, "finished_at": now}
    return _update(session, _claimed(job_id, worker).values(ended))


def hand_back(session: Session, job_id: UUID, worker: UUID) -> bool:
    """Queue a job again whose worker stops before it is done; the attempt does not count."""
    freed = {"state": JobState.QUEUED, "progress": 0.0, "claimed_by": None, "attempts": JobRow.attempts - 1}
    return _update(session, _claimed(job_id, worker).values(freed))


def requeue_orphans(session: Session, now: datetime, silent_s: float) -> list[UUID]:
    """Queue running jobs again that were silent for `silent_s`; fail those that had all attempts."""
    silence = timedelta(seconds=silent_s)
    # A sign of life from the future tells that the clock was set back since.
    is_orphan = or_(JobRow.heartbeat_at <= now - silence, JobRow.heartbeat_at > now + silence)
    orphans = session.scalars(
        select(JobRow).where(JobRow.state == JobState.RUNNING, is_orphan).with_for_update(skip_locked=True)
    ).all()
    for row in orphans:
        if row.attempts < MOST_ATTEMPTS:
            row.state, row.progress, row.claimed_by = JobState.QUEUED, 0.0, None
        else:
            row.state, row.problem, row.finished_at = JobState.FAILED, GIVEN_UP, now
    return [row.id for row in orphans]


def _claimed(job_id: UUID, worker: UUID) -> Update:
    return update(JobRow).where(
        JobRow.id == job_id, JobRow.claimed_by == worker, JobRow.state == JobState.RUNNING
    )


def _update(session: Session, statement: Update) -> bool:
    found = session.execute(statement.returning(JobRow.id), execution_options={"synchronize_session": False})
    return found.first() is not None
