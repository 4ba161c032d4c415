"""A station's camera while it is used: a thread reads it, the newest frame wins, the judged ones are kept.

It connects again by itself, ever more slowly, and says what is wrong meanwhile. Not here: how a kind of
camera is read (adapters), and what a frame leads to (`guide`).
"""

import logging
import threading
from collections import OrderedDict, deque
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from time import monotonic

import cv2
import numpy as np

from service.core.errors import (
    Fact,
    ImageFormatUnsupported,
    ImageTooLarge,
    ImageUnreadable,
    ServiceError,
)
from service.core.guidance.problems import (
    FrameForgotten,
    SourceStalled,
    SourceUnreachable,
    SourceUnreadable,
)
from service.ports import FrameReader, Grabbed, LiveFrame
from service.usecases.guide_frames import Pixels
from service.usecases.guide_views import CameraView
from service.usecases.images import check_image, decode_image

STALE_S = 1.0  # a frame that waited longer says nothing about now
KEPT_S = 1.5  # how long a judged frame can be asked for a capture
FIRST_WAIT_S = 0.25  # before a camera is connected again; doubled each time
LONGEST_WAIT_S = 4.0
CONNECTING_S = 5.0  # a stream begins with a whole picture, for which it may wait a while
RATE_S = 2.0  # over which the rate of the camera is measured

NO_PICTURE_YET = SourceStalled(
    "The camera has not sent a picture yet. It is being connected; if this stays, check its cable, power and "
    "address."
)

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class CameraFrame:
    """A frame, grey (h, w), at full size; at_s: when it arrived, on the clock of this machine.

    camera, source_s: as in `Grabbed`. fps: how many frames the camera sends in a second, None at first.
    """

    sequence: int
    image: Pixels
    at_s: float
    camera: str | None
    source_s: float | None
    fps: float | None
    scale: int = 1


def view_camera(frame: LiveFrame) -> CameraView | None:
    """Return how the camera of a frame keeps up; None where it is none that the service reads."""
    if not isinstance(frame, CameraFrame):
        return None
    waited_ms = 1000.0 * (monotonic() - frame.at_s)
    return CameraView(frame.camera, frame.fps, frame.source_s, waited_ms)


@dataclass(frozen=True)
class _Arrival:
    sequence: int
    at_s: float
    grabbed: Grabbed


class Camera:
    """A camera that is read from now on, until it is closed; frames are asked for by one thread at a time."""

    def __init__(self, read: FrameReader, largest_pixels: int) -> None:
        self._read, self._largest_pixels = read, largest_pixels
        self._changed = threading.Condition()
        self._closed = threading.Event()
        self._newest: _Arrival | None = None
        self._arrived = 0
        self._began_s = monotonic()
        self._times: deque[float] = deque()
        self._kept: OrderedDict[int, CameraFrame] = OrderedDict()
        self._trouble: ServiceError | None = NO_PICTURE_YET
        # No daemon: a process must not end while FFmpeg is at work in one of its threads.
        threading.Thread(target=self._run, name="camera").start()

    @property
    def trouble(self) -> ServiceError | None:
        """Why no picture comes, as far as it is known."""
        return self._trouble

    @property
    def is_connecting(self) -> bool:
        """Whether it is too early to miss its pictures."""
        is_new = monotonic() - self._began_s < CONNECTING_S
        return is_new and self._arrived == 0 and self._trouble is NO_PICTURE_YET

    def next_frame(self, timeout_s: float) -> CameraFrame | None:
        """Return the newest frame that was not returned before; None when none can be had in this time.

        Of those that came meanwhile only the newest is decoded. One that is old, or cannot be decoded, is
        passed over.
        """
        until_s = monotonic() + timeout_s
        while (arrival := self._wait(until_s - monotonic())) is not None:
            if monotonic() - arrival.at_s > STALE_S:
                continue
            try:
                image = _pixels_of(arrival.grabbed, self._largest_pixels)
            except (ImageFormatUnsupported, ImageTooLarge, ImageUnreadable) as error:
                self._trouble = SourceUnreadable(
                    f"{error.detail} Check the format that the camera is set to.", **error.facts
                )
                continue
            self._trouble = None
            return self._keep(arrival, image)
        return None

    def capture(self, sequence: int) -> Pixels:
        """Return the very pixels of a frame that was returned; raises FrameForgotten."""
        frame = self._kept.get(sequence)
        if frame is None:
            raise FrameForgotten(
                f"Frame {sequence} is no longer kept. Hold the board still; the pose is taken again.",
                sequence=sequence,
            )
        return frame.image

    def facts_of(self, sequence: int) -> dict[str, Fact]:
        """Return which frame of which camera it is, for the record of a capture."""
        frame = self._kept.get(sequence)
        return (
            {} if frame is None else {"camera": frame.camera, "frame": sequence, "source_s": frame.source_s}
        )

    def close(self) -> None:
        """Let the camera go; its thread ends once the camera answers, or at its timeout."""
        self._closed.set()
        with self._changed:
            self._changed.notify_all()

    def _wait(self, timeout_s: float) -> _Arrival | None:
        with self._changed:
            self._changed.wait_for(lambda: self._newest is not None or self._closed.is_set(), timeout_s)
            arrival, self._newest = self._newest, None
        return arrival

    def _keep(self, arrival: _Arrival, image: Pixels) -> CameraFrame:
        frame = CameraFrame(
            sequence=arrival.sequence,
            image=image,
            at_s=arrival.at_s,
            camera=arrival.grabbed.camera,
            source_s=arrival.grabbed.source_s,
            fps=self._rate(),
        )
        self._kept[frame.sequence] = frame
        while next(iter(self._kept.values())).at_s < frame.at_s - KEPT_S:
            self._kept.popitem(last=False)
        return frame

    def _rate(self) -> float | None:
        with self._changed:
            times = tuple(self._times)
        passed_s = times[-1] - times[0] if len(times) > 1 else 0.0
        return (len(times) - 1) / passed_s if passed_s > 0 else None

    def _run(self) -> None:
        wait_s = FIRST_WAIT_S
        while not self._closed.is_set():
            before = self._arrived
            self._trouble = self._follow()
            wait_s = FIRST_WAIT_S if self._arrived > before else min(2 * wait_s, LONGEST_WAIT_S)
            self._closed.wait(wait_s)

    def _follow(self) -> ServiceError:
        """Read until the camera goes away; return why it did."""
        try:
            with closing(self._read()) as pictures:
                for grabbed in pictures:
                    self._take(grabbed)
                    if self._closed.is_set():
                        break
        except ServiceError as error:
            log.info("a camera went away: %s", error.code)
            return error
        except Exception:
            # Whatever it is, the camera is tried again; guidance must not end with this thread.
            log.exception("a camera could not be read")
        return SourceUnreachable(
            "The camera ended its stream. It is connected again by itself; check the camera."
        )

    def _take(self, grabbed: Grabbed) -> None:
        with self._changed:
            self._arrived += 1
            self._newest = _Arrival(self._arrived, monotonic(), grabbed)
            self._times.append(self._newest.at_s)
            while self._times[0] < self._newest.at_s - RATE_S:
                self._times.popleft()
            self._changed.notify_all()


CameraOpener = Callable[[str, tuple[int, int]], Camera]
"""Opens a station's source, for a camera of this image size."""


def _pixels_of(grabbed: Grabbed, largest_pixels: int) -> Pixels:
    """Return grey pixels (h, w).

    Raises ImageTooLarge, before anything is decoded, ImageFormatUnsupported, ImageUnreadable.
    """
    if isinstance(grabbed.picture, np.ndarray):
        return grabbed.picture
    name = "The camera's picture"
    header = check_image(grabbed.picture, name)
    if header.width * header.height > largest_pixels:
        raise ImageTooLarge(
            f"{name} has {header.width}x{header.height} px; at most {largest_pixels} px are accepted.",
            largest_pixels=largest_pixels,
        )
    if header.format != "JPEG":
        return decode_image(grabbed.picture, name)
    # The grey of a JPEG is a part of its own: as the camera sent it, and in half the time of its colours.
    pixels = cv2.imdecode(
        np.frombuffer(grabbed.picture, np.uint8), cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION
    )
    # The stubs do not know that imdecode answers None for bytes it cannot read.
    if not isinstance(pixels, np.ndarray) or pixels.shape != (header.height, header.width):
        raise ImageUnreadable(f"{name} cannot be decoded.")
    return np.asarray(pixels, dtype=np.uint8)
