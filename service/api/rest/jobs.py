"""Jobs: work in the background, such as planning a pose set, with its progress."""

from datetime import datetime
from typing import Any
from uuid import UUID

from fastapi import APIRouter
from pydantic import Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, Of, ReadDb
from service.api.shapes import Answer, Id
from service.storage.words import JobState
from service.usecases import jobs

router = APIRouter(prefix="/jobs", tags=["Jobs"])


class Job(Answer):
    """Work in the background."""

    id: UUID
    kind: str
    state: JobState
    progress: float = Field(description="From 0 to 1.")
    result: dict[str, Any] | None = Field(description="What came out, when the state is `done`.")
    problem: dict[str, Any] | None = Field(description="Problem document, when the state is `failed`.")
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None


@router.get("/{job_id}", summary="Read a job")
def read_job(job_id: Id, caller: Viewer, db: ReadDb) -> Job:
    """Read a job's state and progress; ask again until the state is `done`, `failed` or `cancelled`."""
    return Job.model_validate(jobs.get_job(db, job_id))


@router.post("/{job_id}/cancel", summary="Cancel a job")
def cancel_job(job_id: Id, caller: Engineer, db: Db, of: Of, now: Now) -> Job:
    """Cancel a job that has not ended. A running one stops at its next report of progress."""
    return Job.model_validate(jobs.cancel_job(db, of.jobs, job_id, caller.name, now))
