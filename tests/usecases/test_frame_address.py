"""Which sources stations may have, and that what is secret in an address is shown to nobody."""

import pytest

from service.core.errors import SourceRefused
from service.storage.words import FrameOrigin
from service.usecases.frame_address import MASK, check_source, mask_source, origin_of

ACCEPTED = {
    "browser": FrameOrigin.BROWSER,
    "virtual": FrameOrigin.VIRTUAL,
    "virtual:mouse": FrameOrigin.VIRTUAL,
    "rtsp://camera-17/stream1": FrameOrigin.RTSP,
    "rtsp://joe:s3cret@10.0.0.7:8554/cam?channel=1&token=s3cret": FrameOrigin.RTSP,
    "http://[fd00::7]:8080/video.mjpg": FrameOrigin.MJPEG,
    "https://joe:s3cret@camera/stream?s3cret": FrameOrigin.MJPEG,
    "v4l2:/dev/video0": FrameOrigin.V4L2,
    "v4l2:/dev/v4l/by-id/usb-046d_C920_8D81F5DF-video-index0": FrameOrigin.V4L2,
    "v4l2:8D81F5DF": FrameOrigin.V4L2,
    "file:replays/unit 7": FrameOrigin.FILE,
}
REFUSED = [
    "",
    "camera",
    "BROWSER",
    "ftp://camera/stream",
    "gopher://camera",
    "RTSP://camera",
    "rtsp:",
    "rtsp://",
    "rtsp:///stream",
    "http://camera:99999/stream",
    "http://camera:port/stream",
    "http://[fd00::7/stream",
    "http://camera/str eam",
    "http://camera/\r\nX-Header: 1",
    "http://kamera-ä/stream",
    f"http://{MASK}@camera/stream",
    f"http://camera/{'x' * 500}",
    "v4l2:",
    "v4l2:/dev/sda",
    "v4l2:/dev/video0/../sda",
    "v4l2:/dev/v4l/by-id/../../mem",
    "v4l2:*",
    "file:",
    "file:/etc",
    "file:///etc/passwd",
    "file:../secrets",
    "file:a/../../b",
    "file:a\\..\\b",
    "file:a\0b",
    "concat:a|b",
    "data:image/png;base64,AAAA",
]


@pytest.mark.parametrize(("source", "origin"), ACCEPTED.items())
def test_a_source_is_accepted_as_it_is_and_has_a_kind(source: str, origin: FrameOrigin) -> None:
    assert check_source(source, files=True) == source
    assert origin_of(source) is origin


@pytest.mark.parametrize("source", REFUSED)
def test_anything_else_is_refused_with_what_to_do(source: str) -> None:
    with pytest.raises(SourceRefused) as refused:
        check_source(source, files=True)

    assert len(refused.value.detail) > 30


def test_files_are_refused_where_no_directory_is_named() -> None:
    with pytest.raises(SourceRefused, match="DMSCAL_FRAMES_DIR"):
        check_source("file:replays", files=False)


@pytest.mark.parametrize("source", ACCEPTED)
def test_what_is_secret_is_masked_and_the_rest_can_be_recognised(source: str) -> None:
    shown = mask_source(source)

    assert "s3cret" not in shown
    assert "joe" not in shown
    assert mask_source(shown) == shown


def test_a_masked_address_names_scheme_host_path_and_the_names_of_its_query() -> None:
    shown = mask_source("rtsp://joe:s3cret@10.0.0.7:8554/cam?channel=1&token=s3cret")

    assert shown == "rtsp://***@10.0.0.7:8554/cam?channel=***&token=***"
    with pytest.raises(SourceRefused, match="whole address"):
        check_source(shown, files=True)
