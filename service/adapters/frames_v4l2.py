"""Frames of a camera at this machine, by Video4Linux: found by its path or by the serial in its link.

Grey is taken from the raw picture where the device sends it apart: a conversion to colours would stretch it.
Not here: connecting again (`guide_camera`).
"""

from collections.abc import Generator
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from service.adapters.frames_rtsp import check_pixels, opened, to_grey
from service.core.guidance.problems import SourceUnreachable
from service.ports import Grabbed

DEVICES = Path("/dev")
BY_ID = "v4l/by-id"
FIRST_STREAM = "-video-index0"


def read_v4l2(
    source: str, image_size: tuple[int, int], largest_pixels: int, devices: Path = DEVICES
) -> Generator[Grabbed]:
    """Yield the pictures of a device, set to the size that is asked for.

    Raises SourceUnreachable, SourceUnreadable.
    """
    path = find_device(source.removeprefix("v4l2:"), devices)
    camera = name_of(path, devices)
    with opened(str(path), cv2.CAP_V4L2) as capture:
        if not capture.isOpened():
            raise SourceUnreachable(
                f"The camera '{camera}' cannot be opened. Another program may use it, or the service may "
                "not: close the other one, or give the service's user the group `video`."
            )
        capture.set(cv2.CAP_PROP_FRAME_WIDTH, image_size[0])
        capture.set(cv2.CAP_PROP_FRAME_HEIGHT, image_size[1])
        check_pixels(capture, largest_pixels)
        form = int(capture.get(cv2.CAP_PROP_FOURCC)).to_bytes(4, "little", signed=True)
        if form in RAW:
            capture.set(cv2.CAP_PROP_CONVERT_RGB, 0)
        while True:
            is_there, image = capture.read()
            if not is_there:
                raise SourceUnreachable(
                    f"The camera '{camera}' sends no pictures any more. Check its cable; it is connected "
                    "again by itself."
                )
            at_ms = capture.get(cv2.CAP_PROP_POS_MSEC)
            yield Grabbed(grey_of_raw(image, form), camera, at_ms / 1000 if at_ms > 0 else None)


def find_device(name: str, devices: Path = DEVICES) -> Path:
    """Return the device of a path, or of a serial that stands in its link; raises SourceUnreachable."""
    if name.startswith("/dev/"):
        path = devices / name.removeprefix("/dev/")
        if path.exists():
            return path
        raise SourceUnreachable(f"There is no camera '{name}' at this machine. Check that it is plugged in.")
    links = sorted((devices / BY_ID).glob(f"*{FIRST_STREAM}"))
    found = [link for link in links if link.name.endswith(f"_{name}{FIRST_STREAM}")]
    if len(found) != 1:
        raise SourceUnreachable(
            f"There are {len(found)} cameras with the serial '{name}' at this machine. Check that it is "
            "plugged in, or name the camera by its link below /dev/v4l/by-id.",
            cameras=[link.name.removesuffix(FIRST_STREAM) for link in links],
        )
    return found[0]


def name_of(path: Path, devices: Path = DEVICES) -> str:
    """Return the name with which a device's link tells its maker, model and serial; else that of its node."""
    links = sorted((devices / BY_ID).glob(f"*{FIRST_STREAM}"))
    known = (link.name.removesuffix(FIRST_STREAM) for link in links if link.resolve() == path.resolve())
    return next(known, path.resolve().name)


def grey_of_raw(image: NDArray[np.generic], form: bytes) -> NDArray[np.uint8] | bytes:
    """Return grey pixels (h, w) of a picture as a device sent it, or its JPEG; `form` is its FOURCC."""
    raw = np.asarray(image, dtype=np.uint8)
    if form == b"MJPG" and 1 in raw.shape:
        return raw.tobytes()
    if form in GREY_AT and raw.ndim == 3 and raw.shape[2] == 2:
        return np.ascontiguousarray(raw[:, :, GREY_AT[form]])
    return to_grey(raw)


GREY_AT = {b"YUYV": 0, b"UYVY": 1}  # which of a pixel's two bytes is its grey
RAW = frozenset({b"GREY", b"MJPG", *GREY_AT})
