"""A camera that is read: the newest frame wins, judged ones are kept, and it is connected again."""

import threading
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from queue import Queue
from time import monotonic

import cv2
import numpy as np
import pytest

from service.core.guidance.problems import FrameForgotten, SourceUnreachable
from service.ports import Grabbed
from service.usecases import guide_camera
from service.usecases.guide_camera import Camera, CameraFrame
from tests.plant import encode

WAIT_S = 5.0
LARGEST_PIXELS = 100_000


def picture(level: int) -> Grabbed:
    return Grabbed(np.full((4, 6), level, np.uint8), camera="cam-1", source_s=float(level))


class Wire:
    """Where a test puts pictures in, or what ends a connection; `taken` once the camera asks for more."""

    def __init__(self) -> None:
        self.things: Queue[Grabbed | Exception] = Queue()
        self.taken = threading.Semaphore(0)
        self.connected_s: list[float] = []
        self.ended = threading.Event()

    def read(self) -> Generator[Grabbed]:
        self.connected_s.append(monotonic())
        try:
            while True:
                thing = self.things.get(timeout=WAIT_S)
                if isinstance(thing, Exception):
                    raise thing
                yield thing
                self.taken.release()
        finally:
            self.ended.set()

    def put(self, *pictures: Grabbed) -> None:
        """Let pictures arrive."""
        for one in pictures:
            self.things.put(one)
        for _ in pictures:
            assert self.taken.acquire(timeout=WAIT_S)


@contextmanager
def reading(wire: Wire) -> Iterator[Camera]:
    camera = Camera(wire.read, LARGEST_PIXELS)
    try:
        yield camera
    finally:
        camera.close()
        wire.things.put(SourceUnreachable("The test is over. Write another one."))


def frame_of(camera: Camera) -> CameraFrame:
    frame = camera.next_frame(WAIT_S)
    assert frame is not None
    return frame


def test_of_frames_that_wait_only_the_newest_is_returned_and_only_once() -> None:
    wire = Wire()
    with reading(wire) as camera:
        wire.put(picture(1), picture(2), picture(3))
        frame = frame_of(camera)
        wire.things.put(picture(4))
        after = frame_of(camera)

    assert (frame.sequence, frame.image[0, 0], frame.camera, frame.source_s) == (3, 3, "cam-1", 3.0)
    assert (after.sequence, after.image[0, 0]) == (4, 4)
    assert after.at_s >= frame.at_s


def test_without_a_frame_nothing_is_returned_and_why_is_known() -> None:
    with reading(Wire()) as camera:
        assert camera.next_frame(0.01) is None
        assert camera.trouble is not None
        assert camera.trouble.code == "source-stalled"


def test_a_frame_from_before_a_stall_is_not_shown_as_the_present(monkeypatch: pytest.MonkeyPatch) -> None:
    wire = Wire()
    with reading(wire) as camera:
        wire.put(picture(1))
        monkeypatch.setattr(guide_camera, "STALE_S", 0.0)
        assert camera.next_frame(0.01) is None
        monkeypatch.undo()
        wire.things.put(picture(2))

        assert frame_of(camera).image[0, 0] == 2


def test_a_frame_that_was_returned_can_be_captured_and_no_other() -> None:
    wire = Wire()
    with reading(wire) as camera:
        wire.put(picture(1), picture(2))
        frame = frame_of(camera)

        assert camera.capture(frame.sequence) is frame.image
        assert camera.facts_of(frame.sequence) == {"camera": "cam-1", "frame": 2, "source_s": 2.0}
        with pytest.raises(FrameForgotten):
            camera.capture(1)


def test_a_frame_is_forgotten_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guide_camera, "KEPT_S", 0.0)
    wire = Wire()
    with reading(wire) as camera:
        wire.things.put(picture(1))
        first = frame_of(camera)
        wire.things.put(picture(2))
        frame_of(camera)

        with pytest.raises(FrameForgotten):
            camera.capture(first.sequence)


def test_a_picture_that_cannot_be_decoded_is_passed_over_and_said() -> None:
    wire = Wire()
    whole = encode(np.full((40, 60), 7, np.uint8))
    with reading(wire) as camera:
        wire.put(Grabbed(whole[:-20]))
        assert camera.next_frame(0.01) is None
        assert camera.trouble is not None
        assert camera.trouble.code == "source-unreadable"
        wire.things.put(Grabbed(whole))

        assert frame_of(camera).image[0, 0] == 7
        assert camera.trouble is None


def test_the_grey_of_a_colour_jpeg_is_the_one_that_the_camera_sent() -> None:
    wire = Wire()
    colours = np.random.default_rng(3).integers(0, 256, (64, 48, 3), dtype=np.uint8)
    jpeg = encode(colours, ".jpg")
    with reading(wire) as camera:
        wire.things.put(Grabbed(jpeg))
        grey = frame_of(camera).image

    luma = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    np.testing.assert_array_equal(grey, luma)


def test_a_jpeg_that_is_cut_off_is_passed_over() -> None:
    wire = Wire()
    jpeg = encode(np.full((64, 48), 9, np.uint8), ".jpg")
    with reading(wire) as camera:
        wire.put(Grabbed(jpeg[:-40]))
        assert camera.next_frame(0.01) is None
        wire.things.put(Grabbed(jpeg))

        assert frame_of(camera).image.shape == (64, 48)


def test_a_picture_that_is_too_large_is_not_decoded() -> None:
    wire = Wire()
    with reading(wire) as camera:
        wire.put(Grabbed(encode(np.zeros((400, 251), np.uint8))))

        assert camera.next_frame(0.01) is None
        assert camera.trouble is not None
        assert "251x400" in camera.trouble.detail


@pytest.mark.parametrize("end", [SourceUnreachable("It is off. Switch it on."), ValueError("surprise")])
def test_a_camera_that_went_away_is_connected_again(monkeypatch: pytest.MonkeyPatch, end: Exception) -> None:
    monkeypatch.setattr(guide_camera, "FIRST_WAIT_S", 0.01)
    wire = Wire()
    with reading(wire) as camera:
        wire.things.put(picture(1))
        frame_of(camera)
        wire.things.put(end)
        wire.things.put(picture(2))
        frame = frame_of(camera)

    assert frame.sequence == 2
    assert len(wire.connected_s) == 2


def test_a_camera_that_stays_away_is_tried_more_and_more_slowly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guide_camera, "FIRST_WAIT_S", 0.01)
    monkeypatch.setattr(guide_camera, "LONGEST_WAIT_S", 0.08)
    wire = Wire()
    for _ in range(7):
        wire.things.put(SourceUnreachable("It is off. Switch it on."))
    with reading(wire) as camera:
        while wire.things.qsize() > 0:
            assert camera.next_frame(0.01) is None
        assert camera.next_frame(0.01) is None
        assert camera.trouble is not None
        assert camera.trouble.detail == "It is off. Switch it on."

    # Waits of 0.02, 0.04 and then 0.08 s, each at least as long as that.
    assert np.all(np.diff(wire.connected_s)[:6] >= [0.02, 0.04, 0.08, 0.08, 0.08, 0.08])


def test_a_closed_camera_lets_its_connection_go() -> None:
    wire = Wire()
    with reading(wire) as camera:
        wire.put(picture(1))
        camera.close()
        wire.things.put(picture(2))

    assert wire.ended.wait(WAIT_S)
    assert len(wire.connected_s) == 1
