"""What routes ask for: the session of the request, the ports, the time, the part of a list."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Annotated

from fastapi import Depends, Query, Request
from sqlalchemy.orm import Session

from service.ports import BlobStore, Clock, JobQueue
from service.storage.database import Database
from service.usecases.paging import PageRequest
from service.usecases.signing import KeyRing


@dataclass(frozen=True)
class Services:
    """What the composition root hands to the routes; `checks` are what /readyz asks, by name."""

    database: Database
    blobs: BlobStore
    jobs: JobQueue
    clock: Clock
    signing_keys: KeyRing
    max_image_pixels: int
    has_frames_dir: bool
    checks: Mapping[str, Callable[[], None]]


def services(request: Request) -> Services:
    """Return the services of the application."""
    found: Services = request.app.state.services
    return found


Of = Annotated[Services, Depends(services)]


def db_session(of: Of) -> Iterator[Session]:
    """Give a request its transaction: committed when the route returns, rolled back when it raises."""
    with of.database.write() as session:
        yield session


def read_session(of: Of) -> Iterator[Session]:
    """Give a request that changes nothing one state of the database to read."""
    with of.database.read() as session:
        yield session


# scope="function" ends the transaction before the answer goes out; FastAPI's default commits after it, so
# that a failing commit would follow a 2xx. A test holds this.
Db = Annotated[Session, Depends(db_session, scope="function")]
ReadDb = Annotated[Session, Depends(read_session, scope="function")]


def now(of: Of) -> datetime:
    """Return the time of the request."""
    return of.clock.now()


Now = Annotated[datetime, Depends(now)]


def page_request(
    limit: Annotated[int, Query(ge=1, le=200, description="Longest part of the list.")] = 50,
    cursor: Annotated[
        str | None, Query(max_length=200, description="`next_cursor` of the part before.")
    ] = None,
) -> PageRequest:
    """Return which part of a list is asked for."""
    return PageRequest(limit, cursor)


PageOf = Annotated[PageRequest, Depends(page_request)]
