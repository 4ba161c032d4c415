"""A small plant for tests: a camera variant, its poses, its pictures, and callers of each role."""

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout
from functools import cache
from io import StringIO
from pathlib import Path
from typing import Any

import cv2
import httpx2
import numpy as np
from fastapi import FastAPI
from fastapi.testclient import TestClient
from numpy.typing import NDArray

from service.app import create_app
from service.core.planning.plan import PoseSet
from service.core.vision.transforms import Pose
from service.settings import Settings
from service.simulator.renderer import render
from service.simulator.scene import Scene
from service.storage.words import Role
from service.usecases.access import create_key
from service.usecases.planning import PlanRequest, plan_for
from service.usecases.sku_document import Revision, SkuDocument

# A quarter of a megapixel: everything is as in a plant, only faster.
SKU: dict[str, Any] = {
    "code": "tiny",
    "name": "Tiny camera",
    "lens": "pinhole5",
    "image_size": [640, 400],
    "nominal": {"fx": 675.0, "fy": 676.0, "cx": 328.8, "cy": 191.9, "k1": -0.3774, "k2": 0.2425},
    "target": "chessboard:7x5:30mm",
    "pose_count": 8,
    "pose_space": {"separation_px": 30.0, "smallest_square_px": 14.0},
    "limits": {"focal_sd_share": 0.01, "centre_sd_px": 5.0, "zone_mapping_px": 2.0, "valid_mapping_px": 5.0},
}
JsonObject = dict[str, Any]


@cache
def revision() -> Revision:
    """The SKU as the core sees it."""
    return SkuDocument.model_validate(SKU).to_revision()


@cache
def pose_set(count: int = SKU["pose_count"]) -> PoseSet:
    """The poses of the SKU, or so many."""
    sku = SkuDocument.model_validate({**SKU, "pose_count": count}).to_revision()
    return plan_for(sku, PlanRequest(seed=1, candidates=300))


def poses_json(count: int = SKU["pose_count"]) -> list[JsonObject]:
    """The poses, or so many, as they are imported."""
    return [{"rvec": list(pose.rvec), "tvec": list(pose.tvec)} for pose in pose_set(count).poses]


@cache
def picture(index: int) -> bytes:
    """The picture, PNG, that the camera takes of one pose."""
    return encode(shown_at(pose_set().poses[index], index))


def shown_at(pose: Pose, seed: int, blur_px: float = 0.5) -> NDArray[np.uint8]:
    """The picture that the camera takes of a pose."""
    sku = revision()
    scene = Scene(intrinsics=sku.intrinsics, target=sku.target, noise_grey=1.0, blur_px=blur_px)
    return render(scene, pose, np.random.default_rng(seed))


def encode(image: Any, suffix: str = ".png") -> bytes:
    """The bytes of an image file."""
    return bytes(cv2.imencode(suffix, image)[1])


class Plant:
    """The service with one key of each role."""

    def __init__(self, app: FastAPI, client: TestClient, keys: Mapping[Role, str]) -> None:
        self.app = app
        self.client = client
        self.keys = keys

    def call(self, method: str, path: str, role: Role = Role.ADMIN, **rest: Any) -> httpx2.Response:
        """Ask as a role; the path is below /api/v1."""
        headers = {"Authorization": f"Bearer {self.keys[role]}", **rest.pop("headers", {})}
        return self.client.request(method, f"/api/v1{path}", headers=headers, **rest)

    def get(self, path: str, role: Role = Role.VIEWER, **rest: Any) -> httpx2.Response:
        """Read as a viewer."""
        return self.call("GET", path, role, **rest)

    def post(self, path: str, body: Any = None, role: Role = Role.ADMIN, **rest: Any) -> httpx2.Response:
        """Post JSON."""
        return self.call("POST", path, role, json=body, **rest)

    def publish_sku(
        self, with_poses: bool = True, poses: Sequence[JsonObject] | None = None, **changes: Any
    ) -> None:
        """Publish the SKU, with changes, and its pose set (or other poses) if asked."""
        self.expect(201, self.post("/skus", {**SKU, **changes}))
        self.expect(200, self.post("/skus/tiny/revisions/1/publish"))
        if with_poses:
            given = {"poses": poses or poses_json()}
            made = self.expect(201, self.post("/skus/tiny/revisions/1/pose-sets", given))
            self.expect(200, self.post(f"/pose-sets/{made['pose_set']['id']}/publish"))

    def open_run(self, serial: str = "VIN-1", **more: Any) -> str:
        """Open a run and return its id."""
        opened = self.expect(201, self.post("/runs", {"sku": "tiny", "serial": serial, **more}))
        return str(opened["id"])

    def upload(self, run_id: str, index: int) -> httpx2.Response:
        """Upload the picture of a pose as an operator."""
        return self.send(run_id, picture(index), pose_index=index)

    def upload_as(self, run_id: str, shown: int, told: int) -> httpx2.Response:
        """Upload the picture of one pose under the index of another."""
        return self.send(run_id, picture(shown), pose_index=told)

    def send(
        self, run_id: str, content: bytes, pose_index: int | None = None, media_type: str = "image/png"
    ) -> httpx2.Response:
        """Upload bytes as the body, as an operator."""
        query = "" if pose_index is None else f"?pose_index={pose_index}"
        return self.call(
            "POST",
            f"/runs/{run_id}/captures{query}",
            Role.OPERATOR,
            content=content,
            headers={"Content-Type": media_type},
        )

    def finish(self, run_id: str) -> httpx2.Response:
        """Finish a run as an operator."""
        return self.post(f"/runs/{run_id}/finish", role=Role.OPERATOR)

    def finished_run(self, serial: str = "VIN-1") -> str:
        """Calibrate a vehicle and return its run."""
        run_id = self.open_run(serial)
        for index in range(len(pose_set().poses)):
            self.expect(201, self.upload(run_id, index))
        self.expect(200, self.finish(run_id))
        return run_id

    @staticmethod
    def expect(status: int, answer: httpx2.Response) -> JsonObject:
        """The answer's body, if it has this status."""
        assert answer.status_code == status, answer.text
        body: JsonObject = json.loads(answer.text)
        return body


def problem(answer: httpx2.Response, status: int, code: str) -> JsonObject:
    """The problem document of an answer, checked for what every one must have."""
    assert answer.headers["content-type"] == "application/problem+json", answer.text
    body: JsonObject = answer.json()
    assert (answer.status_code, body["code"]) == (status, code), body
    assert body["type"] == f"/problems/{code}"
    assert body["status"] == status
    assert len(body["detail"]) > 10
    assert {"title", "instance", "facts", "trace_id"} <= set(body)
    return body


@contextmanager
def running_plant(database_address: str, directory: Path, **options: Any) -> Iterator[Plant]:
    """The service on a database with its images in a directory, until the block ends.

    options: of the service's settings, and `make_source` for its virtual stations.
    """
    make_source = {"make_source": options.pop("make_source")} if "make_source" in options else {}
    settings = Settings(
        _env_file=None,
        data_dir=directory,
        database_url=database_address,
        blobs_url=f"file:{directory / 'blobs'}",
        **options,
    )
    app = create_app(settings, **make_source)
    with redirect_stdout(StringIO()), TestClient(app, raise_server_exceptions=False) as client:
        services = app.state.services
        with services.database.write() as session:
            keys = {
                role: create_key(session, role.value, role, "test", services.clock.now()).key for role in Role
            }
        yield Plant(app, client, keys)
