"""Folders and videos that are replayed, and what must not be read."""

import time
from itertools import islice
from pathlib import Path

import cv2
import numpy as np
import pytest

from service.adapters import frames_file
from service.adapters.frames_file import read_file
from service.core.guidance.problems import SourceUnreachable, SourceUnreadable
from tests.guiding import pixels

MOST = 1_000_000


@pytest.fixture(autouse=True)
def fast(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody waits for the time of the film."""
    monkeypatch.setattr(time, "sleep", lambda seconds: None)


@pytest.fixture
def frames(tmp_path: Path) -> Path:
    directory = tmp_path / "frames"
    (directory / "unit7").mkdir(parents=True)
    for index in (1, 0):
        cv2.imwrite(str(directory / "unit7" / f"{index}.png"), pixels(index))
    (directory / "unit7" / "notes.txt").write_text("not a picture")
    (tmp_path / "secret.png").write_bytes(b"secret")
    return directory


def write_video(path: Path, code: str = "FFV1", count: int = 3) -> None:
    writer = cv2.VideoWriter(str(path), cv2.CAP_FFMPEG, cv2.VideoWriter.fourcc(*code), 30.0, (640, 400))
    for index in range(count):
        writer.write(cv2.cvtColor(pixels(index), cv2.COLOR_GRAY2BGR))
    writer.release()


def test_a_folder_is_shown_picture_by_picture_over_and_over(frames: Path) -> None:
    times = round(frames_file.SHOWN_S * frames_file.FRAMES_PER_S)

    shown = list(islice(read_file("file:unit7", frames, MOST), 3 * times))

    contents = [(frames / "unit7" / f"{index}.png").read_bytes() for index in (0, 1, 0)]
    assert [one.picture for one in shown[::times]] == contents
    assert {one.camera for one in shown} == {"unit7"}


@pytest.mark.parametrize("name", ["film.avi", "film.mkv"])
def test_a_lossless_video_is_shown_to_the_last_pixel_over_and_over(frames: Path, name: str) -> None:
    write_video(frames / name)

    shown = list(islice(read_file(f"file:{name}", frames, MOST), 7))

    for number, one in enumerate(shown):
        np.testing.assert_array_equal(np.asarray(one.picture), pixels(number % 3))
    assert shown[1].source_s == pytest.approx(1 / 30, abs=0.001)


def test_a_video_that_is_too_large_is_not_read(frames: Path) -> None:
    write_video(frames / "film.avi")

    with pytest.raises(SourceUnreadable, match="640x400"):
        next(read_file("file:film.avi", frames, 255_999))


@pytest.mark.parametrize("name", ["../secret.png", "link.png", "missing", "unit7/../../secret.png"])
def test_nothing_outside_of_the_directory_is_read(frames: Path, tmp_path: Path, name: str) -> None:
    (frames / "link.png").symlink_to(tmp_path / "secret.png")

    with pytest.raises(SourceUnreachable, match="no folder or video"):
        next(read_file(f"file:{name}", frames, MOST))


def test_without_a_directory_nothing_is_read() -> None:
    with pytest.raises(SourceUnreachable, match="DMSCAL_FRAMES_DIR"):
        next(read_file("file:unit7", None, MOST))


@pytest.mark.parametrize(
    "content", [b"", b"#EXTM3U\nhttp://host/part.ts\n", b"ffconcat version 1.0\nfile a\n"]
)
def test_a_list_of_other_files_is_no_video(frames: Path, content: bytes) -> None:
    (frames / "film.avi").write_bytes(content)

    with pytest.raises(SourceUnreadable, match="Convert"):
        next(read_file("file:film.avi", frames, MOST))


def test_a_damaged_video_is_unreadable(frames: Path) -> None:
    (frames / "film.avi").write_bytes(b"RIFF" + bytes(500))

    with pytest.raises(SourceUnreadable):
        next(read_file("file:film.avi", frames, MOST))


def test_a_folder_that_vanishes_or_is_empty_is_said(frames: Path) -> None:
    read = read_file("file:unit7", frames, MOST)
    next(read)
    for path in (frames / "unit7").iterdir():
        path.unlink()
    with pytest.raises(SourceUnreachable):
        list(read)
    (frames / "unit7").rmdir()
    with pytest.raises(SourceUnreachable):
        next(read_file("file:unit7", frames, MOST))
