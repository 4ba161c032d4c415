"""Frames of a folder of images or of a video file, over and over: to replay what a camera saw.

Only below the directory that the service was told, whatever links lead out of it. Not here: decoding images
(`guide_camera`).
"""

import time
from collections.abc import Generator
from pathlib import Path

import cv2

from service.adapters.frames_rtsp import check_pixels, opened, pictures_of
from service.core.guidance.problems import SourceUnreachable, SourceUnreadable
from service.ports import Grabbed

FRAMES_PER_S = 15.0
SHOWN_S = 1.0  # each image of a folder, so that it can be held as long as a capture takes
SUFFIXES = frozenset({".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".pnm", ".bmp", ".tif", ".tiff"})
MOST_BYTES = 80 * 1024 * 1024
# A list of parts elsewhere is a video too, to FFmpeg; these are files that hold their pictures themselves.
VIDEO_STARTS = ((0, b"RIFF"), (0, b"\x1a\x45\xdf\xa3"), (4, b"ftyp"))


def read_file(source: str, directory: Path | None, largest_pixels: int) -> Generator[Grabbed]:
    """Yield the pictures of `file:NAME`; raises SourceUnreachable, SourceUnreadable."""
    path = _find(source.removeprefix("file:"), directory)
    try:
        if path.is_dir():
            yield from _read_folder(path)
        else:
            yield from _read_video(path, largest_pixels)
    except OSError as error:
        raise SourceUnreachable(
            f"'{path.name}' of the station's source cannot be read ({error.strerror}). Check that it is "
            "still there."
        ) from error


def _find(name: str, directory: Path | None) -> Path:
    if directory is None:
        raise SourceUnreachable("`file:` sources are off. Name their directory in DMSCAL_FRAMES_DIR.")
    path = (directory / name).resolve()
    if not path.is_relative_to(directory.resolve()) or not path.exists():
        raise SourceUnreachable(
            f"There is no folder or video '{name}' in the service's directory of frames. Put it there, or "
            "correct the station's source."
        )
    return path


def _read_folder(folder: Path) -> Generator[Grabbed]:
    while True:
        names = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES)
        if not names:
            raise SourceUnreachable(f"The folder '{folder.name}' holds no images. Put some there.")
        for path in names:
            if path.stat().st_size > MOST_BYTES:
                raise SourceUnreadable(f"'{path.name}' has more than {MOST_BYTES} bytes. Take it out.")
            picture = Grabbed(path.read_bytes(), camera=folder.name)
            for _ in range(round(SHOWN_S * FRAMES_PER_S)):
                yield picture
                time.sleep(1.0 / FRAMES_PER_S)


def _read_video(path: Path, largest_pixels: int) -> Generator[Grabbed]:
    with path.open("rb") as file:
        head = file.read(16)
    if not any(head[at:].startswith(start) for at, start in VIDEO_STARTS):
        raise SourceUnreadable(
            f"'{path.name}' is no AVI, MP4, MOV, MKV or WebM file. Convert it to one of these."
        )
    while True:
        with opened(str(path), cv2.CAP_FFMPEG) as capture:
            check_pixels(capture, largest_pixels)
            rate = capture.get(cv2.CAP_PROP_FPS)
            wait_s = 1.0 / rate if 1.0 <= rate <= 240.0 else 1.0 / FRAMES_PER_S
            is_empty = True
            for picture in pictures_of(capture):
                is_empty = False
                yield picture
                time.sleep(wait_s)
        if is_empty:
            raise SourceUnreadable(
                f"'{path.name}' holds no pictures that can be decoded. Convert it, or replace it."
            )
