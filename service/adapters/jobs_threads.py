"""Jobs in threads of this process, out of the table of jobs.

On PostgreSQL any number of processes may work off the same table; on SQLite the service itself does. A job
that was interrupted (a stop, a crash) is queued again. Its handler works outside any transaction; what it
found is written in the transaction that marks it done.
"""

import logging
import threading
import time
from collections.abc import Callable
from uuid import UUID

from sqlalchemy import event
from sqlalchemy.orm import Session

from service.core.errors import InternalError, ServiceError, Unavailable
from service.log import logged_with
from service.ports import Clock, JobCancelled, JobHandlers, JsonObject
from service.storage import jobs
from service.storage.columns import new_id
from service.storage.database import Database

REPORT_S = 0.5
LAST_JOIN_S = 2.0

log = logging.getLogger(__name__)


class JobStopped(JobCancelled):
    """Ends a handler whose worker stops before it is done; the job goes back to the queue."""


class ClaimedJob:
    """A job that this worker runs, as its handler sees it."""

    def __init__(
        self, job_id: UUID, kind: str, arguments: JsonObject, show: Callable[[UUID, float], None]
    ) -> None:
        self.job_id = job_id
        self.kind = kind
        self.arguments = arguments
        self._show = show
        self._shown_at = float("-inf")

    def report(self, progress: float) -> None:
        """Say that `progress` (0 to 1) is done; written at most twice a second; raises JobCancelled."""
        if time.monotonic() - self._shown_at >= REPORT_S:
            self._show(self.job_id, min(max(progress, 0.0), 1.0))
            self._shown_at = time.monotonic()


class ThreadJobs:
    """A job queue with worker threads; before `start()` it only queues, and `run_one()` works by hand."""

    def __init__(
        self,
        database: Database,
        clock: Clock,
        handlers: JobHandlers,
        *,
        threads: int = 1,
        poll_s: float = 1.0,
        stale_s: float = 30.0,
    ) -> None:
        self._database = database
        self._clock = clock
        self._handlers = handlers
        self._poll_s = poll_s
        self._stale_s = stale_s
        self._worker = new_id()
        self._running: set[UUID] = set()
        self._stopping = threading.Event()
        self._interrupted = threading.Event()
        self._queued = threading.Semaphore(0)
        self._workers = [
            threading.Thread(target=self._work, name=f"jobs-{number}", daemon=True)
            for number in range(threads)
        ]
        self._watcher = threading.Thread(target=self._watch, name="jobs-watch", daemon=True)

    def enqueue(self, session: Session, kind: str, arguments: JsonObject) -> UUID:
        """Queue a job in the caller's transaction and return its id; it starts once that commits."""
        job_id = jobs.enqueue(session, kind, arguments, self._clock.now())
        event.listen(session, "after_commit", lambda _: self._queued.release(), once=True)
        return job_id

    def cancel(self, session: Session, job_id: UUID) -> None:
        """Cancel a job that is queued or running; raises NotFound, JobAlreadyEnded."""
        jobs.cancel(session, job_id, self._clock.now())

    def start(self) -> None:
        """Begin to work off the queue, first what an earlier process has left behind."""
        # SQLite has one service, so what is running there belongs to a process that is gone.
        self.requeue_orphans(0.0 if self._database.is_sqlite else self._stale_s)
        for thread in (*self._workers, self._watcher):
            thread.start()

    def stop(self, grace_s: float) -> None:
        """Take no more jobs; let the running ones end within `grace_s`, then hand them back to the queue."""
        self._stopping.set()
        for _ in self._workers:
            self._queued.release()
        self._join(grace_s)
        self._interrupted.set()
        self._join(LAST_JOIN_S)

    def check(self) -> None:
        """Raise Unavailable unless the threads that were started work off the queue."""
        dead = [thread.name for thread in (*self._workers, self._watcher) if not thread.is_alive()]
        if dead or self._stopping.is_set():
            raise Unavailable("Jobs are not worked off here. Restart the service.", threads=dead)

    def run_one(self) -> bool:
        """Run the oldest queued job in this thread; False when there is none."""
        with self._database.write() as session:
            row = jobs.claim(session, self._worker, self._handlers.keys(), self._clock.now())
        if row is None:
            return False
        self._running.add(row.id)
        try:
            with logged_with(job=row.id):
                self._run(ClaimedJob(row.id, row.kind, row.arguments, self._show))
        finally:
            self._running.discard(row.id)
        return True

    def requeue_orphans(self, silent_s: float) -> None:
        """Queue jobs again whose worker showed no sign of life for `silent_s`."""
        with self._database.write() as session:
            orphans = jobs.requeue_orphans(session, self._clock.now(), silent_s)
        for job_id in orphans:
            log.warning("job %s was interrupted", job_id)

    def _run(self, job: ClaimedJob) -> None:
        log.info("job %s started", job.kind)
        try:
            self._complete(job)
        except JobStopped:
            self._settle(
                job, "handed back", lambda session: jobs.hand_back(session, job.job_id, self._worker)
            )
        except JobCancelled:
            log.info("job %s ended: cancelled, or taken over by another worker", job.kind)
        except Unavailable as error:
            # No sign of life is shown any more, so the job is queued again once what it needs may be back.
            log.warning("job %s waits for another try: %s", job.kind, error.detail)
        except ServiceError as error:
            self._fail(job, error)
        except Exception:
            log.exception("job %s crashed", job.kind)
            self._fail(
                job, InternalError("The job failed by a fault of the service. Its log has the reason.")
            )

    def _complete(self, job: ClaimedJob) -> None:
        completion = self._handlers[job.kind](job)
        with self._database.write() as session:
            result = completion(session)
            if not jobs.finish(session, job.job_id, self._worker, self._clock.now(), result):
                raise JobCancelled
        log.info("job %s done", job.kind)

    def _fail(self, job: ClaimedJob, error: ServiceError) -> None:
        problem = {"code": error.code, "title": error.title, "detail": error.detail, "facts": error.facts}
        now = self._clock.now()
        self._settle(
            job, "failed", lambda session: jobs.fail(session, job.job_id, self._worker, now, problem)
        )

    def _settle(self, job: ClaimedJob, what: str, step: Callable[[Session], bool]) -> None:
        try:
            with self._database.write() as session:
                step(session)
            log.info("job %s %s", job.kind, what)
        except Unavailable as error:
            log.warning("job %s could not be marked as %s: %s", job.kind, what, error.detail)

    def _show(self, job_id: UUID, progress: float) -> None:
        if self._interrupted.is_set():
            raise JobStopped
        with self._database.write() as session:
            if not jobs.report(session, job_id, self._worker, self._clock.now(), progress):
                raise JobCancelled

    def _work(self) -> None:
        while not self._stopping.is_set():
            try:
                while not self._stopping.is_set() and self.run_one():
                    pass
            except Exception:
                # A thread that ends here would leave the queue to itself without anyone being told.
                log.exception("the queue of jobs could not be worked off; trying again")
                self._stopping.wait(self._poll_s)
            self._queued.acquire(timeout=self._poll_s)

    def _watch(self) -> None:
        while not self._stopping.wait(self._stale_s / 3):
            try:
                self._show_life()
                self.requeue_orphans(self._stale_s)
            except Unavailable as error:
                log.warning("no sign of life could be shown: %s", error.detail)

    def _show_life(self) -> None:
        running = list(self._running)
        if running:
            with self._database.write() as session:
                for job_id in running:
                    jobs.report(session, job_id, self._worker, self._clock.now())

    def _join(self, timeout_s: float) -> None:
        end = time.monotonic() + timeout_s
        for thread in (*self._workers, self._watcher):
            if thread.is_alive():
                thread.join(max(end - time.monotonic(), 0.0))
