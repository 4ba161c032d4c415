"""Frames of an MJPEG stream over HTTP: `multipart/x-mixed-replace`, as most network cameras serve it.

No redirect is followed and no proxy asked. Not here: decoding, and connecting again (`guide_camera`).
"""

import re
from collections.abc import Generator, Iterator
from contextlib import closing, contextmanager
from time import monotonic
from urllib.parse import unquote, urlsplit

import httpx

from service.core.guidance.problems import SourceStalled, SourceUnreachable, SourceUnreadable
from service.ports import Grabbed

CONNECT_S = 4.0
READ_S = 3.0
MOST_HEAD_BYTES = 8_192
MOST_PICTURE_BYTES = 32_000_000
BOUNDARY = re.compile(r'multipart/x-mixed-replace\s*;.*?boundary\s*=\s*"?-*([^\s";]+)', re.IGNORECASE)
LENGTH = re.compile(rb"^content-length\s*:\s*(\d{1,9})\s*$", re.IGNORECASE | re.MULTILINE)
TIMESTAMP = re.compile(rb"^x-timestamp\s*:\s*(\d{1,12}(?:\.\d{1,9})?)\s*$", re.IGNORECASE | re.MULTILINE)
REFUSED = frozenset({401, 403})


def read_mjpeg(source: str) -> Generator[Grabbed]:
    """Yield the pictures of a stream, as JPEG; raises SourceUnreachable, SourceStalled, SourceUnreadable."""
    host = urlsplit(source).hostname
    timeout = httpx.Timeout(READ_S, connect=CONNECT_S)
    try:
        with httpx.Client(timeout=timeout, trust_env=False) as client, _answer(client, source) as response:
            yield from read_parts(response.iter_raw(), _boundary(response))
    except httpx.ReadTimeout as error:
        raise SourceStalled(
            f"The camera at {host} stopped sending. Check the camera and its network; it is connected again "
            "by itself."
        ) from error
    except (httpx.HTTPError, httpx.InvalidURL, OSError) as error:
        # The message of the error may hold the whole address, and with it a password.
        raise SourceUnreachable(
            f"The camera at {host} does not answer ({type(error).__name__}). Check that it is on and "
            "connected to the network, and that the station's source has the right host and port.",
        ) from error


def read_parts(chunks: Iterator[bytes], boundary: bytes) -> Generator[Grabbed]:
    """Yield the pictures of a multipart body; raises SourceUnreadable, SourceStalled."""
    body = _Body(chunks)
    delimiter = b"--" + boundary
    body.take_until(delimiter, MOST_PICTURE_BYTES)
    while True:
        head = body.take_until(b"\r\n\r\n", MOST_HEAD_BYTES)
        length, taken_s = LENGTH.search(head), TIMESTAMP.search(head)
        if length is None:
            picture = body.take_until(delimiter, MOST_PICTURE_BYTES).removesuffix(b"--").removesuffix(b"\r\n")
        else:
            picture = body.take(min(int(length[1]), MOST_PICTURE_BYTES))
            body.take_until(delimiter, MOST_HEAD_BYTES)
        yield Grabbed(picture, source_s=None if taken_s is None else float(taken_s[1]))


class _Body:
    """A body that is read piece by piece; a picture that takes too long to come has stalled."""

    def __init__(self, chunks: Iterator[bytes]) -> None:
        self._chunks = chunks
        self._bytes = bytearray()

    def take(self, count: int) -> bytes:
        """Return so many bytes."""
        until_s = monotonic() + READ_S
        while len(self._bytes) < count:
            self._read(until_s)
        return self._cut(count, count)

    def take_until(self, mark: bytes, most: int) -> bytes:
        """Return what comes before a mark, which is dropped."""
        until_s, looked = monotonic() + READ_S, 0
        while (found := self._bytes.find(mark, looked)) < 0:
            looked = max(0, len(self._bytes) - len(mark) + 1)
            if looked > most:
                raise SourceUnreadable(
                    "The camera's stream is not made of parts as its header says. Check that the address is "
                    "that of its MJPEG stream."
                )
            self._read(until_s)
        return self._cut(found, found + len(mark))

    def _read(self, until_s: float) -> None:
        chunk = next(self._chunks, None)
        if chunk is None:
            raise SourceUnreachable("The camera ended its stream. It is connected again by itself.")
        self._bytes += chunk
        if monotonic() > until_s:
            raise SourceStalled("The camera sends too slowly. Check its network, or lower its picture rate.")

    def _cut(self, end: int, start: int) -> bytes:
        taken = bytes(self._bytes[:end])
        del self._bytes[:start]
        return taken


def _boundary(response: httpx.Response) -> bytes:
    kind = response.headers.get("content-type", "")
    found = BOUNDARY.match(kind)
    if found is None:
        raise SourceUnreadable(
            f"The camera answers with '{kind[:60]}', not with multipart/x-mixed-replace. Give the address "
            "of its MJPEG stream, as its manual names it.",
        )
    return found[1].encode("ascii", "replace")


@contextmanager
def _answer(client: httpx.Client, source: str) -> Iterator[httpx.Response]:
    """Give the answer of a camera; name and password are sent as it asks for them, basic or digest."""
    parts = urlsplit(source)
    name, password = unquote(parts.username or ""), unquote(parts.password or "")
    request = client.build_request("GET", parts._replace(netloc=parts.netloc.rpartition("@")[2]).geturl())
    response = client.send(request, stream=True, auth=httpx.BasicAuth(name, password) if name else None)
    if name and "digest" in response.headers.get("www-authenticate", "").lower():
        response.close()
        response = client.send(request, stream=True, auth=httpx.DigestAuth(name, password))
    with closing(response):
        _check_status(response.status_code, parts.hostname)
        yield response


def _check_status(status: int, host: str | None) -> None:
    if status in REFUSED:
        raise SourceUnreachable(
            f"The camera at {host} refuses the name and password ({status}). Correct them in the station's "
            "source.",
            status=status,
        )
    if status != httpx.codes.OK:
        raise SourceUnreachable(
            f"The camera at {host} answers with status {status}. Check the path in the station's source.",
            status=status,
        )
