"""Content in files under one directory, named by its SHA-256: `ab/cd/abcd….`

A file appears under its name only when it is whole and on the disk; what a crash leaves behind lies in
`incoming` and is swept at a later start. Content that no row names does no harm: storing it again finds it.
"""

import errno
import hashlib
import logging
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Self
from uuid import uuid4

from service.core.errors import BlobDamaged, BlobMissing, BlobStoreUnavailable, DiskFull, ServiceError

HASH_PATTERN = re.compile(r"[0-9a-f]{64}")
INCOMING = "incoming"
LEFTOVER_S = 3600.0
NO_ROOM = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}

log = logging.getLogger(__name__)


class FileBlobs:
    """A blob store in a directory of this computer or of a share that all replicas mount."""

    def __init__(self, directory: Path) -> None:
        self._directory = directory
        self._incoming = directory / INCOMING

    @classmethod
    def open(cls, address: str) -> Self:
        """Return the store at `file:DIRECTORY`, made if need be and swept; raises Unavailable."""
        blobs = cls(Path(address.removeprefix("file:")).absolute())
        with _as_domain_errors():
            _make_directory(blobs._incoming)
            blobs._sweep()
        return blobs

    def put(self, content: bytes) -> str:
        """Store `content` durably and return its SHA-256 in hex; raises DiskFull, BlobStoreUnavailable."""
        sha256 = _hash(content)
        path = self._path(sha256)
        with _as_domain_errors():
            if path.is_file() and _hash(path.read_bytes()) == sha256:
                # Another process may have put it there without having made its name durable yet.
                _sync_directory(path.parent)
            else:
                self._write(path, content)
        return sha256

    def get(self, sha256: str) -> bytes:
        """Return the content; raises BlobMissing, BlobDamaged, BlobStoreUnavailable."""
        path = self._path(sha256)
        with _as_domain_errors():
            if not path.is_file():
                raise BlobMissing("The image store does not hold this content.", sha256=sha256)
            content = path.read_bytes()
        if _hash(content) != sha256:
            raise BlobDamaged(
                "The stored content has changed on the disk. Restore the file from the backup.", sha256=sha256
            )
        return content

    def contains(self, sha256: str) -> bool:
        """Return whether the content is there."""
        return self._path(sha256).is_file()

    def check(self) -> None:
        """Write and remove a small file; raises DiskFull, BlobStoreUnavailable."""
        with _as_domain_errors(), self._draft(b"probe"):
            pass

    def _path(self, sha256: str) -> Path:
        if not HASH_PATTERN.fullmatch(sha256):
            raise BlobMissing(
                "Content is named by its SHA-256 in 64 lower-case hex digits.", sha256=sha256[:80]
            )
        return self._directory / sha256[:2] / sha256[2:4] / sha256

    def _write(self, path: Path, content: bytes) -> None:
        _make_directory(path.parent)
        with self._draft(content) as draft:
            draft.replace(path)
        _sync_directory(path.parent)

    @contextmanager
    def _draft(self, content: bytes) -> Iterator[Path]:
        path = self._incoming / str(uuid4())
        try:
            with path.open("xb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            yield path
        finally:
            path.unlink(missing_ok=True)

    def _sweep(self) -> None:
        # Ages are told by the disk's own clock; a replica on the same share may be writing right now.
        with self._draft(b"") as probe:
            now_s = probe.stat().st_mtime
        for leftover in self._incoming.iterdir():
            with suppress(FileNotFoundError):
                if now_s - leftover.stat().st_mtime > LEFTOVER_S:
                    log.warning("sweeping %s, left by an interrupted write", leftover.name)
                    leftover.unlink()


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _make_directory(path: Path) -> None:
    # A new name is durable once the directory that holds it is.
    missing = [p for p in (path, *path.parents) if not p.exists()]
    path.mkdir(parents=True, exist_ok=True)
    for made in missing:
        _sync_directory(made.parent)


def _sync_directory(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def _as_domain_errors() -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise _domain_error(error) from error


def _domain_error(error: OSError) -> ServiceError:
    if error.errno in NO_ROOM:
        return DiskFull(
            "The image store has no room left. Nothing was stored; free some space, then try again."
        )
    return BlobStoreUnavailable(
        "The image store cannot be used. Nothing was stored; have its directory checked, then try again.",
        reason=error.strerror,
    )
