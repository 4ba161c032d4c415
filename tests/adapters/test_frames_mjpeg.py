"""MJPEG over HTTP: parts however they are cut, and what is no stream."""

import logging
from collections.abc import Iterator
from contextlib import closing, contextmanager

import pytest

from service.adapters import frames_mjpeg
from service.adapters.frames_mjpeg import read_mjpeg, read_parts
from service.core.errors import ServiceError
from service.core.guidance.problems import SourceStalled, SourceUnreachable, SourceUnreadable
from service.log import configure_logging
from tests.streams import CameraServer, MjpegHandler, Stage, camera_on, jpeg_of_pose, port_of

PICTURES = [b"\xff\xd8one\xff\xd9", b"\xff\xd8\r\n--not the mark\xff\xd9", b"\xff\xd8three\r\n\r\n\xff\xd9"]


def body(with_lengths: bool, preamble: bytes = b"") -> bytes:
    """A stream of the pictures, as cameras write it."""
    parts = [
        b"--mark\r\nContent-type: image/jpeg\r\n"
        + (b"content-length:  %d\r\n" % len(one) if with_lengths else b"")
        + b"X-Timestamp: 12.5\r\n\r\n"
        + one
        + b"\r\n"
        for one in PICTURES
    ]
    return preamble + b"".join(parts) + b"--mark\r\n"


def address(camera: CameraServer, path: str, word: str = "s3cret") -> str:
    return f"http://joe:{word}@127.0.0.1:{port_of(camera)}{path}"


def chunks(content: bytes, size: int) -> Iterator[bytes]:
    return (content[i : i + size] for i in range(0, len(content), size))


@contextmanager
def logging_of_the_service() -> Iterator[None]:
    """Every logger at the level that the service gives it when it is asked for everything."""
    root = logging.getLogger()
    handlers, level = root.handlers[:], root.level
    configure_logging("DEBUG", "text")
    root.handlers[:] = handlers
    try:
        yield
    finally:
        root.setLevel(level)


@pytest.mark.parametrize("with_lengths", [True, False])
@pytest.mark.parametrize("size", [1, 7, 10_000])
@pytest.mark.parametrize("preamble", [b"", b"\r\n", b"ignore this\r\n"])
def test_pictures_come_whole_however_the_stream_is_cut(
    with_lengths: bool, size: int, preamble: bytes
) -> None:
    read = read_parts(chunks(body(with_lengths, preamble), size), b"mark")

    found = [next(read) for _ in PICTURES]

    assert [one.picture for one in found] == PICTURES
    assert found[0].source_s == 12.5
    with pytest.raises(SourceUnreachable):
        next(read)


@pytest.mark.parametrize(
    "content",
    [b"--mark\r\n" + b"x" * 20_000, b"--mark\r\nContent-Length: 5\r\n\r\n12345" + b"y" * 20_000],
    ids=["endless head", "no mark after a picture"],
)
def test_a_stream_that_is_not_made_of_parts_is_unreadable(content: bytes) -> None:
    with pytest.raises(SourceUnreadable):
        list(read_parts(chunks(content, 1000), b"mark"))


def test_a_picture_without_an_end_does_not_fill_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frames_mjpeg, "MOST_PICTURE_BYTES", 50_000)
    taken = 0

    def endless() -> Iterator[bytes]:
        nonlocal taken
        yield b"--mark\r\n\r\n\r\n"
        while True:
            taken += 1000
            yield b"z" * 1000

    with pytest.raises(SourceUnreadable):
        list(read_parts(endless(), b"mark"))
    assert taken < 60_000


def test_a_camera_that_drips_has_stalled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frames_mjpeg, "READ_S", 0.0)

    with pytest.raises(SourceStalled):
        list(read_parts(chunks(body(with_lengths=True), 1), b"mark"))


@pytest.mark.parametrize("path", ["/stream", "/bare", "/locked", "/digest"])
def test_a_stream_is_read_with_name_and_password_as_it_asks_for_them(path: str) -> None:
    with camera_on(MjpegHandler, Stage()) as camera, closing(read_mjpeg(address(camera, path))) as read:
        assert [next(read).picture for _ in range(3)] == [jpeg_of_pose(0)] * 3


@pytest.mark.parametrize("path", ["/locked", "/digest", "/missing", "/still"])
def test_no_error_and_no_log_line_holds_the_password(path: str, caplog: pytest.LogCaptureFixture) -> None:
    with (
        logging_of_the_service(),
        camera_on(MjpegHandler, Stage()) as camera,
        pytest.raises(ServiceError) as refused,
    ):
        next(read_mjpeg(address(camera, f"{path}?token=wrongw0rd", "wrongw0rd")))

    assert "wrongw0rd" not in refused.value.detail + str(refused.value.facts) + caplog.text


@pytest.mark.parametrize("host", ["127.0.0.1:1", "nowhere.invalid"])
def test_a_host_that_does_not_answer_is_unreachable(host: str) -> None:
    with pytest.raises(SourceUnreachable, match="does not answer"):
        next(read_mjpeg(f"http://{host}/stream"))


def test_a_camera_that_keeps_silent_has_stalled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frames_mjpeg, "READ_S", 0.2)
    with camera_on(MjpegHandler, Stage(stalls=True)) as camera, pytest.raises(SourceStalled):
        next(read_mjpeg(f"http://127.0.0.1:{port_of(camera)}/stream"))
