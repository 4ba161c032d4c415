"""RTSP: a real stream, and cameras that are not there or not to be read."""

import socket
import subprocess
import sys
from contextlib import closing

import cv2
import numpy as np
import pytest

from service.adapters import frames_rtsp
from service.adapters.frames_rtsp import read_rtsp
from service.core.guidance.problems import SourceStalled, SourceUnreachable, SourceUnreadable
from tests.rtsp import RtspHandler
from tests.streams import CameraServer, Stage, camera_on, jpeg_of_pose, port_of

MOST = 1_000_000


def address(camera: CameraServer) -> str:
    return f"rtsp://127.0.0.1:{port_of(camera)}/s"


def test_a_stream_gives_its_pictures_in_grey_with_the_cameras_time() -> None:
    jpeg = jpeg_of_pose(0)
    grey = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    with camera_on(RtspHandler, Stage()) as camera, closing(read_rtsp(address(camera), MOST)) as read:
        seen = [next(read) for _ in range(6)]

    first = np.asarray(seen[0].picture)
    assert first.shape == (400, 640)
    # The two decoders may round differently.
    assert np.abs(first.astype(int) - grey).max() <= 3
    times_s = [one.source_s or 0.0 for one in seen]
    assert times_s == sorted(times_s)
    assert 0.05 < times_s[-1] - times_s[0] < 5.0


def test_pictures_that_are_too_large_are_not_read() -> None:
    with camera_on(RtspHandler, Stage()) as camera, pytest.raises(SourceUnreadable, match="640x400"):
        next(read_rtsp(address(camera), 255_999))


def test_a_stream_that_ends_has_stalled() -> None:
    stage = Stage()
    with camera_on(RtspHandler, stage) as camera:
        read = read_rtsp(address(camera), MOST)
        next(read)
        camera.hang_up()
        with pytest.raises(SourceStalled):
            list(read)


def test_a_host_that_does_not_answer_is_unreachable() -> None:
    with pytest.raises(SourceUnreachable, match="does not answer"):
        next(read_rtsp("rtsp://joe:s3cret@127.0.0.1:1/s", MOST))


def test_what_answers_but_speaks_no_rtsp_is_said(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(frames_rtsp, "OPTIONS", (cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, 300))
    with closing(socket.create_server(("127.0.0.1", 0))) as server:
        port = server.getsockname()[1]
        with pytest.raises(SourceUnreachable, match="gives no stream"):
            next(read_rtsp(f"rtsp://joe:s3cret@127.0.0.1:{port}/s", MOST))

    said = capfd.readouterr()
    assert "s3cret" not in said.out + said.err


def test_a_process_that_ends_while_a_stream_is_read_ends_in_order() -> None:
    script = (
        "import sys; from functools import partial; from service.adapters.frames_rtsp import read_rtsp; "
        "from service.usecases.guide_camera import Camera; "
        "camera = Camera(partial(read_rtsp, sys.argv[1], 10**6), 10**6); "
        "frame = camera.next_frame(20.0); camera.close(); print(frame.image.shape)"
    )
    with camera_on(RtspHandler, Stage()) as camera:
        ended = subprocess.run(  # noqa: S603 - our own interpreter
            [sys.executable, "-c", script, address(camera)], capture_output=True, text=True, check=False
        )

    assert (ended.returncode, ended.stdout) == (0, "(400, 640)\n"), ended.stderr
