"""Jobs: look at work in the background and cancel it. What a job does stands with its use case."""

from datetime import datetime
from uuid import UUID

from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.ports import JobQueue
from service.storage.models import JobRow
from service.usecases.audit import record


def get_job(session: Session, job_id: UUID) -> JobRow:
    """Return a job; raises NotFound."""
    row = session.get(JobRow, job_id)
    if row is None:
        raise NotFound("There is no job of this id.", job_id=str(job_id))
    return row


def cancel_job(session: Session, queue: JobQueue, job_id: UUID, who: str, now: datetime) -> JobRow:
    """Cancel a job that has not ended; raises NotFound, JobAlreadyEnded."""
    queue.cancel(session, job_id)
    record(session, now, who, "job.cancel", f"job:{job_id}")
    session.flush()
    session.expire_all()
    return get_job(session, job_id)
