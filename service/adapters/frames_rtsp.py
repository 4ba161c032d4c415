"""Frames of an RTSP stream, read by the FFmpeg that OpenCV carries; over TCP, so that none comes damaged.

Not here: connecting again (`guide_camera`), and video files (`frames_file`).
"""

import socket
from collections.abc import Generator
from contextlib import contextmanager
from urllib.parse import urlsplit

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.guidance.problems import SourceStalled, SourceUnreachable, SourceUnreadable
from service.ports import Grabbed

CONNECT_S = 4.0
OPEN_S = 8.0  # a stream is known once its first whole picture has come, and cameras may send one every few s
READ_S = 3.0
RTSP_PORT = 554
# One thread: with several, FFmpeg holds back as many frames as it has threads.
OPTIONS = (
    *(cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, int(1000 * OPEN_S)),
    *(cv2.CAP_PROP_READ_TIMEOUT_MSEC, int(1000 * READ_S)),
    *(cv2.CAP_PROP_N_THREADS, 1),
)


def read_rtsp(source: str, largest_pixels: int) -> Generator[Grabbed]:
    """Yield the pictures of a stream; raises SourceUnreachable, SourceStalled, SourceUnreadable."""
    parts = urlsplit(source)
    _check_answers(parts.hostname, parts.port or RTSP_PORT)
    with opened(source, cv2.CAP_FFMPEG, OPTIONS) as capture:
        if not capture.isOpened():
            raise SourceUnreachable(
                f"The camera at {parts.hostname} answers, but gives no stream. Check the path, name and "
                "password in the station's source."
            )
        check_pixels(capture, largest_pixels)
        yield from pictures_of(capture)
    raise SourceStalled(
        f"The camera at {parts.hostname} stopped sending. Check the camera and its network; it is connected "
        "again by itself."
    )


@contextmanager
def opened(source: str, backend: int, options: tuple[int, ...] = ()) -> Generator[cv2.VideoCapture]:
    """Give a capture of a source, opened or not, and let it go; options: property, value, property, …"""
    capture = cv2.VideoCapture(source, backend, options)
    try:
        yield capture
    finally:
        capture.release()


def check_pixels(capture: cv2.VideoCapture, largest_pixels: int) -> None:
    """Raise SourceUnreadable for pictures that are larger than is accepted."""
    width, height = (int(capture.get(one)) for one in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT))
    if width * height > largest_pixels:
        raise SourceUnreadable(
            f"The camera sends {width}x{height} px; at most {largest_pixels} px are accepted.",
            largest_pixels=largest_pixels,
        )


def pictures_of(capture: cv2.VideoCapture) -> Generator[Grabbed]:
    """Yield what a capture reads, with the time that its source gives, until nothing comes."""
    while True:
        is_there, image = capture.read()
        if not is_there:
            return
        at_ms = capture.get(cv2.CAP_PROP_POS_MSEC)
        yield Grabbed(to_grey(image), source_s=at_ms / 1000 if at_ms >= 0 else None)


def to_grey(image: NDArray[np.generic]) -> NDArray[np.uint8]:
    """Return grey pixels (h, w) of a decoded picture; the same as decoded where it has no colour."""
    pixels = np.asarray(image, dtype=np.uint8)
    if pixels.ndim == 2:
        return pixels
    return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), dtype=np.uint8)


def _check_answers(host: str | None, port: int) -> None:
    """Raise SourceUnreachable unless somebody listens; FFmpeg does not say what went wrong."""
    try:
        socket.create_connection((host or "", port), CONNECT_S).close()
    except OSError as error:
        raise SourceUnreachable(
            f"The camera at {host}:{port} does not answer. Check that it is on and connected to the network, "
            "and that the station's source has the right host and port."
        ) from error
