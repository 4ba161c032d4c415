"""The guidance socket at a station whose kiosk has the camera."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from service.api.ws import drivers
from tests.guiding import Client, Film, add_station, connected, pixels
from tests.plant import Plant, picture, running_plant

SERIAL = "VIN-1"


@pytest.fixture
def station(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """A plant with a station whose kiosk has the camera."""
    with running_plant(sqlite_address, tmp_path, max_image_megapixels=1) as running:
        running.publish_sku()
        add_station(running, source="browser")
        yield running


class Camera:
    """A browser's camera that shows the pictures of the poses, and obeys the hints of each state."""

    def __init__(self, client: Client, serial: str = SERIAL) -> None:
        self.client, self.serial = client, serial
        self.film = Film()
        self.hints: tuple[Any, ...] = ()

    def send_live(self) -> int:
        frame = self.film.next_frame(self.hints, 1 / 15)
        self.send(frame.image, frame.sequence)
        return frame.sequence

    def send_full(self, sequence: int) -> None:
        self.send(self.film.capture(sequence), sequence, full=True)

    def send(self, image: Any, sequence: int, **changes: Any) -> None:
        height, width = image.shape
        head = {
            "type": "frame",
            "sequence": sequence,
            "width": width,
            "height": height,
            "scale": 1,
            "full": False,
            "at_ms": sequence * 1000 / 15,
            "serial": self.serial,
        } | changes
        text = json.dumps(head).encode()
        self.client.socket.send_bytes(len(text).to_bytes(4, "little") + text + image.tobytes())

    def run_until(self, kind: str) -> dict[str, Any]:
        """Show frames and answer what is asked for until a message of a type comes."""
        self.send_live()
        for _ in range(2000):
            heard = self.client.hear()
            if heard["type"] == kind:
                return heard
            if heard["type"] == "want_full_frame":
                self.send_full(heard["sequence"])
            if heard["type"] == "state":
                self.hints = tuple(Hinted(hint["code"]) for hint in heard["hints"])
                self.send_live()
        raise AssertionError(f"{kind} was not told")


class Hinted:
    """A hint as the film reads it."""

    def __init__(self, code: str) -> None:
        self.code = code


def opened(kiosk: Client) -> dict[str, Any]:
    kiosk.say("open_run", serial=SERIAL, sku="tiny")
    return kiosk.until("run")


def test_a_run_is_guided_by_the_kiosks_own_camera_to_a_pass(station: Plant) -> None:
    with connected(station) as kiosk:
        run = opened(kiosk)
        verdict = Camera(kiosk).run_until("verdict")

    stored = station.get(f"/runs/{run['run_id']}").json()
    assert (verdict["verdict"], stored["verdict"], stored["purpose"]) == ("PASS", "PASS", "production")
    assert kiosk.jpeg == b""


def test_a_capture_is_the_raw_frame_without_any_loss(station: Plant) -> None:
    with connected(station) as kiosk:
        opened(kiosk)
        accepted = Camera(kiosk).run_until("capture_accepted")

    answer = station.get(f"/captures/{accepted['capture_id']}/image")
    stored = cv2.imdecode(np.frombuffer(answer.content, np.uint8), cv2.IMREAD_UNCHANGED)
    assert answer.headers["content-type"] == "image/png"
    assert stored is not None
    assert np.array_equal(stored, pixels(accepted["pose_index"]))
    assert answer.content != picture(accepted["pose_index"])


def test_half_size_frames_guide_as_well(station: Plant) -> None:
    half = cv2.resize(pixels(0), None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    with connected(station) as kiosk:
        opened(kiosk)
        Camera(kiosk).send(half, 1, scale=2)
        state = kiosk.until("state")

    outline = state["seen"]["outline"]
    assert state["board"] == "present"
    assert np.ptp(np.array(outline)[:, 0]) > 50
    assert state["difference"]["corner_px"] < 5


def test_a_camera_of_another_size_is_told_once_and_guidance_goes_on(station: Plant) -> None:
    with connected(station) as kiosk:
        opened(kiosk)
        camera = Camera(kiosk)
        for sequence in (1, 2):
            camera.send(np.zeros((300, 400), np.uint8), sequence)
        problem = kiosk.until("problem")
        camera.send(pixels(0), 3)
        state = kiosk.until("state")

    assert (problem["code"], problem["facts"]["found"]) == ("wrong-image-size", [400, 300])
    assert state["sequence"] == 3
    assert [m["type"] for m in kiosk.told].count("problem") == 1


def test_frames_of_another_vehicle_are_dropped(station: Plant) -> None:
    with connected(station) as kiosk:
        opened(kiosk)
        camera = Camera(kiosk, serial="VIN-OTHER")
        camera.send(pixels(0), 1)
        camera.send(pixels(0), 2, serial=SERIAL)

        assert kiosk.until("state")["sequence"] == 2


def test_a_camera_that_stalls_is_told(station: Plant, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drivers, "STALLED_S", 0.3)
    with connected(station) as kiosk:
        opened(kiosk)
        assert kiosk.until("problem")["code"] == "source-stalled"
        Camera(kiosk).send(pixels(0), 1)
        kiosk.until("state")
        assert kiosk.until("problem")["code"] == "source-stalled"


def test_a_full_frame_that_does_not_come_is_given_up(station: Plant, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drivers, "FULL_FRAME_S", 0.3)
    with connected(station) as kiosk:
        opened(kiosk)
        camera = Camera(kiosk)
        camera.run_until("want_full_frame")
        missed = kiosk.until("capture_refused")
        accepted = camera.run_until("capture_accepted")

    assert missed["code"] == "frame-missing"
    assert accepted["pose_index"] == missed["pose_index"]


def test_a_board_that_moved_before_the_full_frame_is_not_taken(station: Plant) -> None:
    with connected(station) as kiosk:
        run = opened(kiosk)
        camera = Camera(kiosk)
        wanted = camera.run_until("want_full_frame")
        camera.send(pixels(5), wanted["sequence"], full=True)
        refused = kiosk.until("capture_refused")

    assert refused["code"] == "frame-moved"
    assert station.get(f"/runs/{run['run_id']}").json()["captures"] == 0


def test_a_frame_with_missing_bytes_ends_the_socket(station: Plant) -> None:
    with connected(station) as kiosk:
        opened(kiosk)
        Camera(kiosk).send(pixels(0), 1, width=641)
        assert kiosk.until("problem")["code"] == "bad-request"
        assert kiosk.socket.receive()["code"] == 4400


@pytest.mark.parametrize("garbage", ["no json", b"\xff" * 40, b"\x02\x00\x00\x00{}" + b"x" * 3_000_000])
def test_garbage_in_the_middle_of_a_run_loses_no_capture(station: Plant, garbage: str | bytes) -> None:
    with connected(station) as kiosk:
        opened(kiosk)
        accepted = Camera(kiosk).run_until("capture_accepted")
        kiosk.socket.send_text(garbage) if isinstance(garbage, str) else kiosk.socket.send_bytes(garbage)
        assert kiosk.until("problem")["code"] in {"bad-request", "too-large"}

    with connected(station) as kiosk:
        assert kiosk.until("run")["captured"] == [accepted["pose_index"]]


def test_a_full_frame_that_nobody_asked_for_changes_nothing(station: Plant) -> None:
    with connected(station) as kiosk:
        run = opened(kiosk)
        camera = Camera(kiosk)
        camera.send(pixels(0), 77, full=True)
        camera.send(pixels(0), 78)
        kiosk.until("state")

    assert station.get(f"/runs/{run['run_id']}").json()["captures"] == 0
