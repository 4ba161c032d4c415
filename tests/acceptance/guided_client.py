"""A kiosk for acceptance tests: a client of the guidance socket of a service in a process of its own."""

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from websockets.sync.client import ClientConnection, connect

from service.core.planning.plan import plan_pose_set
from service.demo.customer import Customer
from service.demo.skus import PAPER_SKUS
from service.usecases.sku_document import SkuDocument

Json = dict[str, Any]
STATION = "virtual1"
SILENCE_S = 60.0


@dataclass
class Kiosk:
    """What a kiosk says and hears; every picture is acknowledged."""

    socket: ClientConnection
    pictures: int = 0
    captured: list[int] = field(default_factory=list)

    def say(self, kind: str, **fields: Any) -> None:
        self.socket.send(json.dumps({"type": kind, **fields}))

    def until(self, kind: str, within_s: float = 200.0) -> Json:
        """The next message of a type."""
        deadline = time.monotonic() + within_s
        while time.monotonic() < deadline:
            message = self.socket.recv(timeout=SILENCE_S)
            if isinstance(message, bytes):
                head = json.loads(message[4 : 4 + int.from_bytes(message[:4], "little")])
                self.pictures += 1
                self.say("ack", sequence=head["sequence"])
            else:
                head = json.loads(message)
            if head["type"] == "capture_accepted":
                self.captured = head["captured"]
            if head["type"] == kind:
                return dict(head)
        raise AssertionError(f"no {kind} within {within_s:g} s")


@contextmanager
def kiosk(url: str, key: str) -> Iterator[Kiosk]:
    """A kiosk of the virtual station that was welcomed."""
    address = f"ws{url.removeprefix('http')}/ws/v1/stations/{STATION}/guidance"
    with connect(address, compression=None, max_size=32_000_000) as socket:
        client = Kiosk(socket)
        client.say("hello", key=key, protocol=1, role="kiosk")
        client.until("welcome")
        yield client


def set_up_lens1(customer: Customer, poses: int) -> None:
    """Publish the paper's Lens 1 with a short pose set, and register a virtual station."""
    document = {**PAPER_SKUS[0], "pose_count": poses}
    revision = SkuDocument.model_validate(document).to_revision()
    planned = plan_pose_set(
        revision.intrinsics,
        revision.target,
        revision.pose_space,
        poses,
        1,
        sigma_px=revision.corner_noise_px,
    )
    customer.describe_sku(document)
    given = [{"rvec": pose.rvec.tolist(), "tvec": pose.tvec.tolist()} for pose in planned.poses]
    made = customer.ask("POST", "/skus/lens1/revisions/1/pose-sets", json={"poses": given})
    customer.ask("POST", f"/pose-sets/{made['pose_set']['id']}/publish")
    customer.add_virtual_station(STATION, "Virtual station")
