"""What use cases ask of the outside world, as Protocols.

A Protocol stands here only where two implementations exist (a fake of the tests counts). The database is not
one of them: SQLAlchemy already is the port between SQLite and PostgreSQL.
"""

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Protocol
from uuid import UUID

import numpy as np
from numpy.typing import NDArray
from sqlalchemy.orm import Session

from service.core.guidance.hints import ShownHint
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target

JsonObject = dict[str, Any]


class Clock(Protocol):
    """Tells the time."""

    def now(self) -> datetime:
        """Return the time now, aware and in UTC."""
        ...


class BlobStore(Protocol):
    """Keeps bytes under the SHA-256 of their content; what is stored never changes."""

    def put(self, content: bytes) -> str:
        """Store `content` durably and return its SHA-256 in hex; storing it again changes nothing.

        Raises BlobStoreUnavailable, with nothing half-written, when it cannot be stored.
        """
        ...

    def get(self, sha256: str) -> bytes:
        """Return the content; raises BlobMissing, or BlobDamaged when it is not what was stored."""
        ...

    def contains(self, sha256: str) -> bool:
        """Return whether the content is there."""
        ...

    def check(self) -> None:
        """Raise BlobStoreUnavailable unless content could be stored now."""
        ...


class JobCancelled(Exception):
    """Ends a handler whose job was cancelled or taken over; raised by `JobRun.report`."""


class JobRun(Protocol):
    """One job that is running, as its handler sees it."""

    @property
    def job_id(self) -> UUID:
        """The id of the job."""
        ...

    @property
    def arguments(self) -> JsonObject:
        """What the job was queued with."""
        ...

    def report(self, progress: float) -> None:
        """Say that `progress` (0 to 1) is done; cheap enough for an inner loop; raises JobCancelled."""
        ...


JobCompletion = Callable[[Session], JsonObject]
"""Writes what a job has found, in the very transaction that marks it done, and returns the job's result."""

JobHandler = Callable[[JobRun], JobCompletion]
"""Does a job's work outside any transaction. After a crash it runs again, so only its completion writes."""

JobHandlers = Mapping[str, JobHandler]


class JobQueue(Protocol):
    """Work in the background; a job is queued in the caller's transaction and exists when that commits."""

    def enqueue(self, session: Session, kind: str, arguments: JsonObject) -> UUID:
        """Queue a job and return its id; `kind` names its handler."""
        ...

    def cancel(self, session: Session, job_id: UUID) -> None:
        """Cancel a job that is queued or running; raises JobNotFound, JobAlreadyEnded."""
        ...


class LiveFrame(Protocol):
    """One frame of a station's camera."""

    @property
    def sequence(self) -> int:
        """Number of the frame, rising."""
        ...

    @property
    def image(self) -> NDArray[np.uint8]:
        """Grey pixels (h, w)."""
        ...

    @property
    def scale(self) -> int:
        """Full-size pixels per pixel of the frame: 1 or 2."""
        ...

    @property
    def at_s(self) -> float:
        """When it was taken, on a clock of the source that only goes forward."""
        ...


class FrameSource(Protocol):
    """A camera within the service, pulled frame by frame; not for two threads at once."""

    def next_frame(self, hints: tuple[ShownHint, ...], dt_s: float) -> LiveFrame:
        """Return the frame that follows `dt_s` after the last one, with these hints on the screen."""
        ...

    def capture(self, sequence: int) -> NDArray[np.uint8]:
        """Return the full picture (h, w) of the very moment that a frame shows; raises FrameForgotten."""
        ...


FrameSourceMaker = Callable[[Intrinsics, Target, str], FrameSource]
"""Makes the source of a run from the SKU's nominal camera, its target and the vehicle's serial."""


@dataclass(frozen=True)
class BoardMove:
    """How a person moves a virtual board, in the camera's directions, from where it is.

    right_px, down_px: of its centre in the raw image. closer_share: > -1; its distance is divided by 1 + it.
    Angles as in `core.guidance.comparison`: tilt > 0 brings the top edge to the camera, turn > 0 takes the
    left edge away, roll > 0 is clockwise.
    """

    right_px: float = 0.0
    down_px: float = 0.0
    closer_share: float = 0.0
    tilt_rad: float = 0.0
    turn_rad: float = 0.0
    roll_rad: float = 0.0


HeldSourceMaker = Callable[[Intrinsics, Target, str, Callable[[], BoardMove | None]], FrameSource]
"""As FrameSourceMaker, of a board that a person moves; the last argument returns the moves since the last
call."""


@dataclass(frozen=True)
class Grabbed:
    """A picture as a camera gave it: grey pixels (h, w), or the bytes of an image file that holds them.

    camera: what the device calls itself, if it does. source_s: when it was taken, by the camera's own clock.
    """

    picture: NDArray[np.uint8] | bytes
    camera: str | None = None
    source_s: float | None = None


FrameReader = Callable[[], Generator[Grabbed]]
"""Connects to a camera and yields its pictures as they come, until closed; waits a few seconds at most.

Raises SourceUnreachable, SourceStalled, SourceUnreadable; whoever reads connects again by calling it again.
"""
