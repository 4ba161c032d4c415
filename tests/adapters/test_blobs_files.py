"""Files: whole or not there at all, whatever happens while they are written."""

import multiprocessing
import os
import resource
import signal
import time
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from pathlib import Path

import pytest

from service.adapters.blobs_files import INCOMING, LEFTOVER_S, FileBlobs
from service.core.errors import BlobDamaged, BlobStoreUnavailable, DiskFull


def stored_files(directory: Path) -> list[Path]:
    return [path for path in directory.rglob("*") if path.is_file()]


def test_files_lie_two_directories_deep(tmp_path: Path) -> None:
    sha256 = FileBlobs.open(f"file:{tmp_path}").put(b"image")

    assert stored_files(tmp_path) == [tmp_path / sha256[:2] / sha256[2:4] / sha256]


def test_content_that_changed_on_the_disk_is_told_and_healed_by_storing_it_again(tmp_path: Path) -> None:
    blobs = FileBlobs.open(f"file:{tmp_path}")
    sha256 = blobs.put(b"image")
    stored_files(tmp_path)[0].write_bytes(b"imagf")

    with pytest.raises(BlobDamaged):
        blobs.get(sha256)
    blobs.put(b"image")
    assert blobs.get(sha256) == b"image"


def test_old_leftovers_of_a_crash_are_swept_at_the_start_and_young_ones_left(tmp_path: Path) -> None:
    incoming = tmp_path / INCOMING
    incoming.mkdir()
    (incoming / "old").write_bytes(b"half an im")
    (incoming / "young").write_bytes(b"half an im")
    hours_ago = time.time() - 2 * LEFTOVER_S  # noqa: TID251 - the disk's own clock is meant
    os.utime(incoming / "old", (hours_ago, hours_ago))

    FileBlobs.open(f"file:{tmp_path}")

    assert [path.name for path in incoming.iterdir()] == ["young"]


def test_many_threads_may_store_the_same_content(tmp_path: Path) -> None:
    blobs = FileBlobs.open(f"file:{tmp_path}")
    content = os.urandom(200_000)

    with ThreadPoolExecutor(8) as threads:
        names = set(threads.map(blobs.put, [content] * 40))

    assert len(names) == 1
    assert blobs.get(names.pop()) == content
    assert len(stored_files(tmp_path)) == 1


def test_a_directory_that_cannot_be_used_is_unavailable(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")

    with pytest.raises(BlobStoreUnavailable):
        FileBlobs.open(f"file:{tmp_path / 'file'}")


def test_a_directory_that_vanished_is_unavailable(tmp_path: Path) -> None:
    blobs = FileBlobs.open(f"file:{tmp_path / 'blobs'}")
    (tmp_path / "blobs" / INCOMING).rmdir()

    with pytest.raises(BlobStoreUnavailable):
        blobs.check()


def _store_with_little_room(directory: Path, answer: Connection) -> None:
    # A file size limit makes the write fail half-way, with the errno of a full quota or disk.
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
    try:
        FileBlobs.open(f"file:{directory}").put(b"x" * 1_000_000)
    except DiskFull as error:
        answer.send(error.code)


def test_without_room_nothing_is_half_written(tmp_path: Path) -> None:
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_store_with_little_room, args=(tmp_path, sender))
    process.start()
    process.join(20)

    assert receiver.poll()
    assert receiver.recv() == "disk-full"
    assert stored_files(tmp_path) == []


def _store_for_ever(directory: Path, answer: Connection) -> None:
    blobs = FileBlobs.open(f"file:{directory}")
    while True:
        answer.send(blobs.put(os.urandom(300_000)))


@pytest.mark.parametrize("delay_s", [0.02, 0.05, 0.11])
def test_after_a_kill_all_that_was_acknowledged_is_whole(tmp_path: Path, delay_s: float) -> None:
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_store_for_ever, args=(tmp_path, sender))
    process.start()
    acknowledged = [receiver.recv()]
    time.sleep(delay_s)
    process.kill()
    process.join()
    while receiver.poll():
        acknowledged.append(receiver.recv())

    blobs = FileBlobs.open(f"file:{tmp_path}")
    assert all(len(blobs.get(sha256)) == 300_000 for sha256 in acknowledged)
    named = [path for path in stored_files(tmp_path) if path.parent.name != INCOMING]
    assert all(path.stat().st_size == 300_000 for path in named)
