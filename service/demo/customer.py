"""What an engineer and an MES do over HTTP: describe a SKU, let it be planned, calibrate a vehicle."""

import time
import uuid
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Self

import cv2
import httpx
import numpy as np
from numpy.typing import NDArray

Json = dict[str, Any]


class Refused(Exception):
    """The service answered with a problem document."""


@dataclass(frozen=True)
class Customer:
    """A client with a key."""

    http: httpx.Client

    @classmethod
    def of(cls, url: str, key: str) -> Self:
        """Return a customer of the service at an address."""
        headers = {"Authorization": f"Bearer {key}"}
        return cls(httpx.Client(base_url=f"{url}/api/v1", headers=headers, timeout=120.0))

    def ask(self, method: str, path: str, **request: Any) -> Json:
        """Return the answer; raises Refused with what the problem document says."""
        answer = self.http.request(method, path, **request)
        if answer.is_error:
            problem = answer.json()
            raise Refused(f"{method} {path}: {problem['title']}: {problem['detail']}")
        body: Json = answer.json()
        return body

    def describe_sku(self, document: Json) -> None:
        """Create a SKU and publish its first revision."""
        self.ask("POST", "/skus", json=document)
        self.ask("POST", f"/skus/{document['code']}/revisions/1/publish")

    def add_virtual_station(self, code: str, name: str, source: str = "virtual") -> None:
        """Register a station whose camera is simulated, and its hand too unless the source is another."""
        self.ask("POST", "/stations", json={"code": code, "name": name, "source": source})

    def plan_poses(self, code: str, progress: Callable[[float], None]) -> Json:
        """Let the service plan the poses of a SKU, publish the set and return it."""
        asked = self.ask("POST", f"/skus/{code}/revisions/1/pose-sets", json={"seed": 1})
        while (job := self.ask("GET", f"/jobs/{asked['job']['id']}"))["state"] in {"queued", "running"}:
            progress(job["progress"])
            time.sleep(0.1)
        if job["state"] != "done":
            raise Refused(f"planning {code}: {job['problem']}")
        progress(1.0)
        return self.ask("POST", f"/pose-sets/{asked['pose_set']['id']}/publish")

    def calibrate(self, order: Json, images: Iterable[NDArray[np.uint8]]) -> Json:
        """Open a run, send one lossless image per prescribed pose, finish, and return the result."""
        run = self.ask("POST", "/runs", json=order, headers={"Idempotency-Key": str(uuid.uuid4())})
        for index, image in enumerate(images):
            png = cv2.imencode(".png", image)[1].tobytes()
            name = f"pose-{index + 1:02d}.png"
            self.ask(
                "POST",
                f"/runs/{run['id']}/captures",
                params={"pose_index": index},
                files={"image": (name, png, "image/png")},
            )
        return self.ask("POST", f"/runs/{run['id']}/finish")
