"""Cameras at this machine: how a device is found, and what its raw pictures mean. No device is needed."""

from pathlib import Path

import numpy as np
import pytest

from service.adapters.frames_v4l2 import find_device, grey_of_raw, name_of, read_v4l2
from service.core.guidance.problems import SourceUnreachable

C920 = "usb-046d_HD_Pro_Webcam_C920_8D81F5DF"
GREY = np.random.default_rng(1).integers(0, 256, (4, 6), dtype=np.uint8)
OTHER = np.full_like(GREY, 128)


@pytest.fixture
def devices(tmp_path: Path) -> Path:
    """Two cameras, of which the first has a second stream, as udev links them."""
    by_id = tmp_path / "v4l" / "by-id"
    by_id.mkdir(parents=True)
    links = {f"{C920}-video-index0": 0, f"{C920}-video-index1": 1, "usb-Maker_Cam_77-video-index0": 2}
    for name, number in links.items():
        (tmp_path / f"video{number}").touch()
        (by_id / name).symlink_to(f"../../video{number}")
    return tmp_path


def test_a_camera_is_found_by_its_serial_whatever_its_number(devices: Path) -> None:
    assert find_device("8D81F5DF", devices).resolve() == devices / "video0"
    assert find_device("77", devices).resolve() == devices / "video2"


@pytest.mark.parametrize("name", ["/dev/video2", "/dev/v4l/by-id/usb-Maker_Cam_77-video-index0"])
def test_a_camera_is_found_by_its_path_and_called_by_its_link(devices: Path, name: str) -> None:
    path = find_device(name, devices)

    assert path.resolve() == devices / "video2"
    assert name_of(path, devices) == "usb-Maker_Cam_77"


def test_a_camera_without_a_link_is_called_by_its_number(devices: Path) -> None:
    (devices / "video9").touch()

    assert name_of(find_device("/dev/video9", devices), devices) == "video9"


@pytest.mark.parametrize("name", ["/dev/video5", "7", "Cam", "0000"])
def test_a_camera_that_is_not_there_is_said(devices: Path, name: str) -> None:
    with pytest.raises(SourceUnreachable, match="plugged in"):
        find_device(name, devices)


def test_what_is_no_camera_cannot_be_opened(devices: Path) -> None:
    with pytest.raises(SourceUnreachable, match="cannot be opened"):
        next(read_v4l2("v4l2:77", (640, 400), 1_000_000, devices))


@pytest.mark.parametrize(
    ("form", "raw"),
    [
        (b"GREY", GREY),
        (b"YUYV", np.dstack([GREY, OTHER])),
        (b"UYVY", np.dstack([OTHER, GREY])),
        (b"RGB3", np.dstack([GREY, GREY, GREY])),
    ],
)
def test_grey_is_taken_from_a_raw_picture_as_the_device_sent_it(form: bytes, raw: np.ndarray) -> None:
    grey = grey_of_raw(raw, form)

    np.testing.assert_array_equal(np.asarray(grey), GREY)


def test_a_jpeg_of_a_device_stays_as_it_is() -> None:
    assert grey_of_raw(np.frombuffer(b"\xff\xd8jpeg", np.uint8).reshape(1, -1), b"MJPG") == b"\xff\xd8jpeg"
