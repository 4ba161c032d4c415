"""Composition root of a process that only works off jobs, any number of them beside a service on PostgreSQL.

Run as `python -m service.worker`. On SQLite the service runs its jobs itself: that database is one process's.
"""

import logging
import signal
import sys
import threading
from contextlib import closing

from service.adapters.clock_system import SystemClock
from service.adapters.jobs_threads import ThreadJobs
from service.core.errors import BadRequest, ServiceError
from service.log import configure_logging
from service.settings import Settings
from service.storage.database import Database
from service.storage.migration import check_at_head
from service.usecases.board_learning import LEARN_BOARD_SHAPE, learn_board_shape_job
from service.usecases.planning import PLAN_POSE_SET, plan_pose_set_job

log = logging.getLogger(__name__)


def run_worker(settings: Settings, stop: threading.Event) -> None:
    """Work off jobs until `stop` is set; raises BadRequest on SQLite, and what opening a database raises."""
    with closing(Database.open(settings.database_url)) as database:
        if database.is_sqlite:
            raise BadRequest("On SQLite the service runs the jobs itself. A worker needs PostgreSQL.")
        check_at_head(database)
        jobs = ThreadJobs(
            database,
            SystemClock(),
            {
                PLAN_POSE_SET: plan_pose_set_job(database),
                LEARN_BOARD_SHAPE: learn_board_shape_job(database),
            },
            threads=settings.jobs.threads,
            poll_s=settings.jobs.poll_s,
            stale_s=settings.jobs.stale_s,
        )
        jobs.start()
        log.info("working off jobs, %d at a time", settings.jobs.threads)
        stop.wait()
        jobs.stop(settings.shutdown_grace_s)
        log.info("stopped")


def main() -> int:
    """Run a worker until SIGTERM or SIGINT; return the exit status."""
    settings = Settings()
    configure_logging(settings.log_level, settings.log_format)
    stop = threading.Event()
    for ending in (signal.SIGTERM, signal.SIGINT):
        signal.signal(ending, lambda *_: stop.set())
    try:
        run_worker(settings, stop)
    except ServiceError as error:
        sys.stderr.write(f"{error.detail}\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
