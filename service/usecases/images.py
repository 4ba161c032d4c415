"""Uploaded bytes to grey pixels, safely: nothing may exhaust memory or reach a decoder unchecked.

Accepted are PNG, JPEG, PNM (PGM, PPM), BMP and TIFF of 8 bits per sample. Colour is turned to grey by
OpenCV's weights; an alpha channel is dropped, for a camera has none. The pixels stay as the sensor delivered
them: an orientation in the file's metadata is not applied. Not here: finding the target, and whether the size
suits the camera (core).
"""

import hashlib
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import ImageFormatUnsupported, ImageTooLarge, ImageUnreadable
from service.usecases.image_header import DamagedError, ImageHeader, read_header

LARGEST_BYTES = 80 * 1024 * 1024
LARGEST_PIXELS = 24_000_000
SUFFIXES = frozenset({".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".pnm", ".bmp", ".tif", ".tiff"})
FORMATS = "PNG, JPEG, PGM, PPM, BMP or TIFF"


def decode_image(data: bytes, name: str) -> NDArray[np.uint8]:
    """Return the grey pixels (height, width) of an image file.

    name: for the messages only. Raises ImageTooLarge (bytes, or pixels by its header), ImageFormatUnsupported
    (another format, or more than 8 bits) and ImageUnreadable (cut off or damaged).
    """
    header = check_image(data, name)
    try:
        pixels = cv2.imdecode(
            np.frombuffer(data, dtype=np.uint8), cv2.IMREAD_UNCHANGED | cv2.IMREAD_IGNORE_ORIENTATION
        )
    except cv2.error as error:
        raise _unreadable(name, "its content cannot be decoded") from error
    # The stubs do not know that imdecode answers None for bytes it cannot read.
    if not isinstance(pixels, np.ndarray):
        raise _unreadable(name, "its content cannot be decoded")
    if pixels.shape[:2] != (header.height, header.width):
        raise _unreadable(name, "its content has another size than its header says")
    if pixels.dtype != np.uint8:
        raise _depth(name, pixels.dtype.itemsize * 8)
    return _to_grey(pixels.astype(np.uint8, copy=False))


def read_image_file(path: Path) -> bytes:
    """Return a file's bytes, one more than is accepted at most; raises ImageUnreadable."""
    try:
        with path.open("rb") as file:
            return file.read(LARGEST_BYTES + 1)
    except OSError as error:
        raise ImageUnreadable(f"{path.name} cannot be read: {error.strerror}.", name=path.name) from error


def check_image(data: bytes, name: str) -> ImageHeader:
    """Return what an image file declares, or raise as `decode_image` does; nothing is decoded."""
    if len(data) > LARGEST_BYTES:
        raise ImageTooLarge(
            f"{name} has {len(data) / 1e6:.0f} MB; at most {LARGEST_BYTES / 1e6:.0f} MB are accepted.",
            bytes=len(data),
            largest_bytes=LARGEST_BYTES,
        )
    try:
        header = read_header(data)
    except DamagedError as error:
        raise _unreadable(name, str(error)) from error
    if header is None:
        raise ImageFormatUnsupported(
            f"{name} is not a {FORMATS} file. Save the image in one of these formats.", name=name
        )
    if header.bits > 8:
        raise _depth(name, header.bits)
    if header.width < 1 or header.height < 1:
        raise _unreadable(name, "it declares no pixels")
    if header.width * header.height > LARGEST_PIXELS:
        raise ImageTooLarge(
            f"{name} declares {header.width}x{header.height} px; at most {LARGEST_PIXELS / 1e6:.0f} million "
            "are accepted. Send the image as the camera delivers it.",
            width=header.width,
            height=header.height,
            largest_pixels=LARGEST_PIXELS,
        )
    return header


def image_sha256(data: bytes) -> str:
    """Return the content hash of an image file, hex."""
    return hashlib.sha256(data).hexdigest()


def _to_grey(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    if pixels.ndim == 2:
        return np.ascontiguousarray(pixels)
    code = cv2.COLOR_BGRA2GRAY if pixels.shape[2] == 4 else cv2.COLOR_BGR2GRAY
    return np.asarray(cv2.cvtColor(pixels, code), dtype=np.uint8)


def _unreadable(name: str, reason: str) -> ImageUnreadable:
    return ImageUnreadable(f"{name} cannot be read: {reason}. Send the whole file again.", name=name)


def _depth(name: str, bits: int) -> ImageFormatUnsupported:
    return ImageFormatUnsupported(
        f"{name} has {bits} bits per pixel and channel. Save it with 8 bits; calibration needs no more.",
        name=name,
        bits=bits,
    )
