"""The contract of a blob store, for the fake and for files."""

import hashlib
from collections.abc import Callable
from pathlib import Path

import pytest

from service.adapters.blobs_files import FileBlobs
from service.core.errors import BlobMissing
from service.ports import BlobStore
from tests.fakes import MemoryBlobs

STORES: dict[str, Callable[[Path], BlobStore]] = {
    "memory": lambda _: MemoryBlobs(),
    "files": lambda directory: FileBlobs.open(f"file:{directory / 'blobs'}"),
}


@pytest.fixture(params=STORES)
def blobs(request: pytest.FixtureRequest, tmp_path: Path) -> BlobStore:
    return STORES[request.param](tmp_path)


@pytest.mark.parametrize("content", [b"", b"image", bytes(range(256)) * 5000], ids=["empty", "short", "long"])
def test_what_is_stored_comes_back_under_its_hash(blobs: BlobStore, content: bytes) -> None:
    sha256 = blobs.put(content)

    assert sha256 == hashlib.sha256(content).hexdigest()
    assert blobs.get(sha256) == content
    assert blobs.contains(sha256)


def test_storing_the_same_again_changes_nothing(blobs: BlobStore) -> None:
    assert blobs.put(b"image") == blobs.put(b"image")
    assert blobs.get(blobs.put(b"image")) == b"image"


def test_what_was_never_stored_is_missing(blobs: BlobStore) -> None:
    with pytest.raises(BlobMissing):
        blobs.get("0" * 64)
    assert not blobs.contains("0" * 64)


@pytest.mark.parametrize(
    "name", ["", "abc", "../" * 20 + "abcd", "A" * 64, "0" * 63 + "\n", "/etc/passwd" + "0" * 53]
)
def test_a_name_that_is_no_hash_is_missing(blobs: BlobStore, name: str) -> None:
    with pytest.raises(BlobMissing):
        blobs.get(name)


def test_a_working_store_passes_its_check(blobs: BlobStore) -> None:
    blobs.check()
