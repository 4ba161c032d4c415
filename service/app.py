"""Composition root of the service: builds it from settings, and ends it in order.

Nothing is opened before the application starts, so that it can be described without a data directory.
"""

import logging
import sys
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from functools import partial
from pathlib import Path

from anyio import to_thread
from fastapi import FastAPI

from service.adapters.blobs_files import FileBlobs
from service.adapters.clock_system import SystemClock
from service.adapters.frames_file import read_file
from service.adapters.frames_mjpeg import read_mjpeg
from service.adapters.frames_rtsp import read_rtsp
from service.adapters.frames_v4l2 import read_v4l2
from service.adapters.jobs_threads import ThreadJobs
from service.adapters.signing_keys_files import load_signing_keys
from service.api.application import create_api
from service.api.dependencies import Services
from service.api.ws.desk import Desks
from service.api.ws.drivers import Pace
from service.api.ws.guidance import Guidance
from service.ports import Clock, FrameReader, FrameSourceMaker
from service.settings import Settings
from service.simulator.virtual_station import held_source_of_serial, source_of_serial
from service.storage.database import Database
from service.storage.migration import check_at_head, upgrade
from service.storage.words import FrameOrigin
from service.usecases.access import create_first_key
from service.usecases.board_learning import LEARN_BOARD_SHAPE, learn_board_shape_job
from service.usecases.frame_address import origin_of
from service.usecases.guide import Plant
from service.usecases.guide_camera import Camera, CameraOpener
from service.usecases.planning import PLAN_POSE_SET, plan_pose_set_job
from service.usecases.signing import KeyRing

# A request's transaction outlasts the thread that began it: its commit needs one again. If all threads could
# wait for the database, none would be left for whoever holds it; so there is one for every request.
MOST_REQUESTS = 1000

HURRIED_FRAMES_PER_S = 10.0

log = logging.getLogger(__name__)


def create_app(settings: Settings, make_source: FrameSourceMaker = source_of_serial) -> FastAPI:
    """Return the application of these settings; it opens what it needs when it is started.

    make_source: what virtual stations see.
    """

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        to_thread.current_default_thread_limiter().total_tokens = MOST_REQUESTS
        database = await to_thread.run_sync(open_database, settings)
        clock = SystemClock()
        jobs = create_jobs(settings, database, clock)
        try:
            services = await to_thread.run_sync(create_services, settings, database, jobs, clock)
            app.state.services = services
            app.state.guidance = create_guidance(settings, services, make_source)
            announce_first_key(database, clock, settings.data_dir)
            if settings.jobs.in_service:
                jobs.start()
            yield
        finally:
            if settings.jobs.in_service:
                await to_thread.run_sync(jobs.stop, settings.shutdown_grace_s)
            database.close()

    return create_api(lifespan, max_image_bytes=settings.max_upload_mb * 1_000_000)


def create_app_from_environment() -> FastAPI:
    """Return the application of the environment's settings, for servers that import it by name."""
    return create_app(Settings())


def open_database(settings: Settings) -> Database:
    """Return the database at this version's tables.

    The embedded one is brought there; a plant's is migrated on purpose, by `dmscal migrate`, for other
    replicas use it. Raises DatabaseUnreachable, DatabaseOutdated.
    """
    database = Database.open(settings.database_url)
    if database.is_sqlite:
        upgrade(database)
    check_at_head(database)
    return database


def open_key_ring(settings: Settings) -> KeyRing:
    """Return the keys that sign certificates; the first of all is made. Raises Unavailable."""
    signer, older = load_signing_keys(Path(settings.signing_keys_dir))
    return KeyRing.of(signer, older)


def create_jobs(settings: Settings, database: Database, clock: Clock) -> ThreadJobs:
    """Return the queue of jobs with a handler for each kind; it is not started."""
    return ThreadJobs(
        database,
        clock,
        {
            PLAN_POSE_SET: plan_pose_set_job(database),
            LEARN_BOARD_SHAPE: learn_board_shape_job(database),
        },
        threads=settings.jobs.threads,
        poll_s=settings.jobs.poll_s,
        stale_s=settings.jobs.stale_s,
    )


def create_services(settings: Settings, database: Database, jobs: ThreadJobs, clock: Clock) -> Services:
    """Return what the routes use."""
    blobs = FileBlobs.open(settings.blobs_url)
    checks: Mapping[str, Callable[[], None]] = {
        "database": database.check,
        "schema": lambda: check_at_head(database),
        "images": blobs.check,
    }
    if settings.jobs.in_service:
        checks = {**checks, "jobs": jobs.check}
    return Services(
        database=database,
        blobs=blobs,
        jobs=jobs,
        clock=clock,
        signing_keys=open_key_ring(settings),
        max_image_pixels=settings.max_image_megapixels * 1_000_000,
        has_frames_dir=bool(settings.frames_dir),
        checks=checks,
    )


def create_guidance(settings: Settings, services: Services, make_source: FrameSourceMaker) -> Guidance:
    """Return what the guidance socket uses."""
    plant = Plant(
        services.database,
        services.blobs,
        services.clock,
        services.signing_keys,
        services.max_image_pixels,
    )
    speed = settings.virtual_speed
    # Whoever is in a hurry sees fewer frames of the same movement.
    pace = Pace(speed=speed) if speed <= 1 else Pace(frames_per_s=HURRIED_FRAMES_PER_S, speed=speed)
    return Guidance(
        plant=plant,
        desks=Desks(plant),
        make_source=make_source,
        make_held_source=held_source_of_serial,
        open_camera=create_camera_opener(settings),
        pace=pace,
    )


def create_camera_opener(settings: Settings) -> CameraOpener:
    """Return what opens the sources of stations whose cameras the service reads."""
    directory = Path(settings.frames_dir) if settings.frames_dir else None
    most = settings.max_image_megapixels * 1_000_000

    def open_camera(source: str, image_size: tuple[int, int]) -> Camera:
        readers: dict[FrameOrigin, FrameReader] = {
            FrameOrigin.RTSP: partial(read_rtsp, source, most),
            FrameOrigin.MJPEG: partial(read_mjpeg, source),
            FrameOrigin.V4L2: partial(read_v4l2, source, image_size, most),
            FrameOrigin.FILE: partial(read_file, source, directory, most),
        }
        return Camera(readers[origin_of(source)], most)

    return open_camera


def largest_socket_message(settings: Settings) -> int:
    """Return how many bytes a server must let through in one message, so that the service can refuse it."""
    return settings.max_image_megapixels * 1_000_000 + 1_000_000


def announce_first_key(database: Database, clock: Clock, data_dir: Path) -> None:
    """On the first start of all, make an administrator's key and print it, this once."""
    with database.write() as session:
        made = create_first_key(session, clock.now())
    if made is not None:
        # Printed and not logged: logs are collected and kept.
        sys.stdout.write(f"First API key (role admin) for {data_dir}, shown this once: {made.key}\n")
        sys.stdout.flush()
