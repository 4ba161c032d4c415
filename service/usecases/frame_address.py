"""Addresses of the cameras that stations get their frames from: which are accepted, and how they are shown.

`browser` and `virtual` stand for the kiosk's own camera and the simulator. Passwords in addresses are kept
for the camera and shown to nobody. Not here: reading frames (adapters).
"""

import re
from collections.abc import Callable
from pathlib import PurePosixPath
from urllib.parse import SplitResult, urlsplit

from service.core.errors import SourceRefused
from service.storage.words import FrameOrigin

MASK = "***"
HELD = "virtual:mouse"  # a virtual camera whose board the person at the kiosk moves
MOST_CHARACTERS = 500
KINDS = (
    "`browser`, `virtual`, `virtual:mouse`, `rtsp://HOST/…`, `http://HOST/…` or `https://HOST/…` (MJPEG), "
    "`v4l2:/dev/videoN`, `v4l2:SERIAL`, or `file:NAME`"
)
PLAIN_SOURCES: dict[str, FrameOrigin] = {
    FrameOrigin.BROWSER: FrameOrigin.BROWSER,
    FrameOrigin.VIRTUAL: FrameOrigin.VIRTUAL,
    HELD: FrameOrigin.VIRTUAL,
}
ORIGINS = {
    "rtsp": FrameOrigin.RTSP,
    "http": FrameOrigin.MJPEG,
    "https": FrameOrigin.MJPEG,
    "v4l2": FrameOrigin.V4L2,
    "file": FrameOrigin.FILE,
}
PLAIN = re.compile(r"[!-~]+")
DEVICE = re.compile(r"/dev/(video\d{1,3}|v4l/by-(id|path)/[\w.:+-]+)|[\w.:+-]+", re.ASCII)


def origin_of(source: str) -> FrameOrigin:
    """Return the kind of an accepted source."""
    if source in PLAIN_SOURCES:
        return PLAIN_SOURCES[source]
    return ORIGINS[source.partition(":")[0]]


def check_source(source: str, *, files: bool) -> str:
    """Return a source that stations may have; raises SourceRefused.

    files: whether there is a directory for `file:` sources.
    """
    if source in PLAIN_SOURCES:
        return source
    scheme, colon, rest = source.partition(":")
    origin = ORIGINS.get(scheme) if colon else None
    if origin is None:
        raise SourceRefused(f"This is no source of frames. Give {KINDS}.")
    if len(source) > MOST_CHARACTERS or (origin is not FrameOrigin.FILE and not PLAIN.fullmatch(source)):
        raise SourceRefused(
            f"An address has at most {MOST_CHARACTERS} plain characters without spaces. Write others as %XX."
        )
    if MASK in source:
        raise SourceRefused(f"This address was shown with {MASK} for what is secret. Give the whole address.")
    if origin is FrameOrigin.FILE and not files:
        raise SourceRefused(
            "`file:` sources are off. Name the directory that they may replay in DMSCAL_FRAMES_DIR and "
            "start the service again."
        )
    CHECKS.get(origin, _check_host)(rest if origin in CHECKS else source)
    return source


def mask_source(source: str) -> str:
    """Return a source as it may be shown: without name, password and values of its query."""
    if origin_of(source) not in {FrameOrigin.RTSP, FrameOrigin.MJPEG}:
        return source
    parts = urlsplit(source)
    host = parts.netloc.rpartition("@")[2]
    netloc = f"{MASK}@{host}" if "@" in parts.netloc else host
    query = re.sub(r"(^|&)([^=&]*)=[^&]*", rf"\1\2={MASK}", parts.query)
    if parts.query and "=" not in parts.query:
        query = MASK
    return SplitResult(parts.scheme, netloc, parts.path, query, "").geturl()


def _check_host(source: str) -> None:
    try:
        parts = urlsplit(source)
        is_whole = bool(parts.hostname) and parts.port != 0 and not parts.fragment
    except ValueError:
        is_whole = False
    if not is_whole:
        raise SourceRefused(
            "The address names no host, or a port that cannot be. Give SCHEME://HOST:PORT/PATH."
        )


def _check_device(name: str) -> None:
    if not DEVICE.fullmatch(name):
        raise SourceRefused(
            "Name the device as `v4l2:/dev/videoN`, by its link `v4l2:/dev/v4l/by-id/…`, or by its serial "
            "`v4l2:SERIAL`.",
        )


def _check_file(name: str) -> None:
    path = PurePosixPath(name)
    if not name or "\0" in name or "\\" in name or path.is_absolute() or ".." in path.parts:
        raise SourceRefused(
            "A `file:` source is the name of a folder or video below the service's directory of frames: "
            "`file:NAME`, without a leading / and without `..`."
        )


CHECKS: dict[FrameOrigin, Callable[[str], None]] = {
    FrameOrigin.V4L2: _check_device,
    FrameOrigin.FILE: _check_file,
}
