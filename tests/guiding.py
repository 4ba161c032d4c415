"""For tests of guidance: a camera that shows the pictures of the small plant, and clients of the socket."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from starlette.testclient import WebSocketTestSession

from service.core.guidance.hints import Hint, ShownHint
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.storage.words import Role
from service.usecases.guide_frames import RawFrame
from service.usecases.planning import PlanRequest, plan_for
from service.usecases.sku_document import SkuDocument
from tests.plant import Plant, picture, pose_set, running_plant

JsonObject = dict[str, Any]
GOOD = {Hint.HOLD, Hint.HOLD_STILL}
ADDRESS = "/ws/v1/stations/{code}/guidance"


@cache
def pixels(index: int) -> NDArray[np.uint8]:
    """The picture of one of the small plant's poses."""
    decoded = cv2.imdecode(np.frombuffer(picture(index), np.uint8), cv2.IMREAD_GRAYSCALE)
    return np.asarray(decoded, dtype=np.uint8)


class Film:
    """Shows the pictures of the poses one after another, and stays where the hints say so."""

    def __init__(self) -> None:
        self._sequence = 0
        self._index = 0
        self._shown: dict[int, int] = {}

    def next_frame(self, hints: tuple[ShownHint, ...], dt_s: float) -> RawFrame:
        if hints and hints[0].code not in GOOD:
            self._index = (self._index + 1) % len(pose_set().poses)
        self._sequence += 1
        self._shown[self._sequence] = self._index
        return RawFrame(self._sequence, pixels(self._index), 1, self._sequence * dt_s)

    def capture(self, sequence: int) -> NDArray[np.uint8]:
        return pixels(self._shown[sequence])


def film(nominal: Intrinsics, target: Target, serial: str) -> Film:
    """The source of every virtual station of a test."""
    return Film()


@contextmanager
def planned_station(address: str, folder: Path, document: JsonObject) -> Iterator[Plant]:
    """A plant with a SKU, its planned poses, and a virtual station whose hand reads only hints."""
    with running_plant(address, folder, virtual_speed=1000) as running:
        running.expect(201, running.post("/skus", document))
        running.expect(200, running.post("/skus/tiny/revisions/1/publish"))
        planned = plan_for(
            SkuDocument.model_validate(document).to_revision(), PlanRequest(seed=1, candidates=300)
        )
        poses = [{"rvec": list(pose.rvec), "tvec": list(pose.tvec)} for pose in planned.poses]
        made = running.expect(201, running.post("/skus/tiny/revisions/1/pose-sets", {"poses": poses}))
        running.expect(200, running.post(f"/pose-sets/{made['pose_set']['id']}/publish"))
        add_station(running)
        yield running


def add_station(plant: Plant, code: str = "cal1", source: str = "virtual") -> None:
    """Register a station."""
    plant.expect(201, plant.post("/stations", {"code": code, "name": code, "source": source}))


@dataclass
class Client:
    """A client of the socket that acknowledges pictures and remembers what it was told."""

    socket: WebSocketTestSession
    told: list[JsonObject] = field(default_factory=list)
    jpeg: bytes = b""

    def say(self, kind: str, **fields: Any) -> None:
        self.socket.send_text(json.dumps({"type": kind, **fields}))

    def hear(self) -> JsonObject:
        """The next message."""
        message = self.socket.receive()
        self.socket._raise_on_close(message)
        if message.get("bytes") is not None:
            content = message["bytes"]
            end = 4 + int.from_bytes(content[:4], "little")
            heard, self.jpeg = json.loads(content[4:end]), content[end:]
            self.say("ack", sequence=heard["sequence"])
        else:
            heard = json.loads(message["text"])
        self.told.append(heard)
        return dict(heard)

    def until(self, is_it: str | Callable[[JsonObject], bool]) -> JsonObject:
        """The first message of a type, or for which something holds."""
        for _ in range(3000):
            heard = self.hear()
            if heard["type"] == is_it if isinstance(is_it, str) else is_it(heard):
                return heard
        raise AssertionError(f"{is_it} was not told")

    def captures(self, count: int) -> JsonObject:
        """The message of the capture by which the run has so many."""
        return self.until(lambda m: m["type"] == "capture_accepted" and len(m["captured"]) == count)


@contextmanager
def connected(
    plant: Plant, code: str = "cal1", kind: str = "kiosk", role: Role = Role.OPERATOR
) -> Iterator[Client]:
    """A client that was welcomed."""
    with plant.client.websocket_connect(ADDRESS.format(code=code)) as socket:
        client = Client(socket)
        client.say("hello", key=plant.keys[role], protocol=1, role=kind)
        client.until("welcome")
        yield client
