"""Fakes of the ports; each passes the contract test of the real adapter (tests/adapters)."""

import hashlib
from datetime import UTC, datetime, timedelta

from service.core.errors import BlobMissing

START = datetime(2026, 3, 1, 6, 0, tzinfo=UTC)


class FakeClock:
    """A clock that stands still until it is moved."""

    def __init__(self, start: datetime = START) -> None:
        self._now = start

    def now(self) -> datetime:
        return self._now

    def advance(self, seconds: float) -> None:
        self._now += timedelta(seconds=seconds)


class MemoryBlobs:
    """A blob store that forgets."""

    def __init__(self) -> None:
        self._contents: dict[str, bytes] = {}

    def put(self, content: bytes) -> str:
        sha256 = hashlib.sha256(content).hexdigest()
        self._contents[sha256] = content
        return sha256

    def get(self, sha256: str) -> bytes:
        if sha256 not in self._contents:
            raise BlobMissing("The image store does not hold this content.", sha256=sha256)
        return self._contents[sha256]

    def contains(self, sha256: str) -> bool:
        return sha256 in self._contents

    def check(self) -> None:
        return None
