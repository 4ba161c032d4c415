"""A camera whose nominal focal length is 10 % off: runs at a virtual station refine it until it settles."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np
import pytest

from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.simulator.frame_source import VirtualSource, make_virtual_source
from service.simulator.operator import Habits, Hand
from service.simulator.scene import Scene
from tests.api.rest.test_pose_sets import ended
from tests.guiding import add_station, connected
from tests.plant import SKU, Plant, problem, revision, running_plant

TRUE = revision().intrinsics
# The lens's design is known, its focal length is ten percent too short, and its centre is the image's.
ROUGH = {
    **SKU,
    "code": "rough",
    "nominal": {**SKU["nominal"], "fx": 607.5, "fy": 608.4, "cx": 319.5, "cy": 199.5},
    "pose_count": 6,
}


def true_camera(nominal: Intrinsics, target: Target, serial: str) -> VirtualSource:
    """The station's camera is the true one, whatever the SKU believes."""
    scene = Scene(TRUE, target, noise_grey=1.0, blur_px=0.5, clutter=0.2)
    hand = Hand(target, None, Habits(lapses_per_s=0.0))
    return make_virtual_source(scene, hand, np.random.default_rng(7))


@pytest.fixture
def station(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    with running_plant(sqlite_address, tmp_path, make_source=true_camera, virtual_speed=1000) as running:
        running.expect(201, running.post("/skus", ROUGH))
        add_station(running)
        yield running


def publish(plant: Plant, number: int, pose_set: dict[str, Any], job: dict[str, Any]) -> dict[str, Any]:
    """Wait for a plan, publish it with its revision, and return it."""
    assert ended(plant, job["id"])["problem"] is None
    plant.expect(200, plant.post(f"/skus/rough/revisions/{number}/publish"))
    return plant.expect(200, plant.post(f"/pose-sets/{pose_set['id']}/publish"))


def guide(plant: Plant, serial: str) -> str:
    """Let the hand take all poses and return the run's id."""
    with connected(plant) as kiosk:
        kiosk.say("open_run", serial=serial, sku="rough")
        # A station first tells of the vehicle before.
        run = kiosk.until(lambda told: told["type"] == "run" and told["serial"] == serial)
        kiosk.until("verdict")
    return str(run["run_id"])


def test_runs_refine_a_roughly_known_camera_until_its_plan_is_settled(station: Plant) -> None:
    asked = station.expect(202, station.post("/skus/rough/revisions/1/pose-sets", {"candidates": 400}))
    publish(station, 1, asked["pose_set"], asked["job"])
    settled = []
    for number in (2, 3):
        made = station.expect(
            202,
            station.post(
                "/skus/rough/refine", {"run_id": guide(station, f"VIN-{number}"), "candidates": 400}
            ),
        )
        assert made["revision"] == number
        planned = publish(station, number, made["pose_set"], made["job"])
        settled.append(planned["provenance"]["follows"]["is_settled"])

    found = station.get("/skus/rough/revisions/3").json()["document"]
    assert settled == [False, True]
    assert found["nominal"]["fx"] == pytest.approx(TRUE.parameters["fx"], abs=1.0)


def test_a_run_of_another_sku_refines_nothing(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.finished_run()
    small_plant.expect(201, small_plant.post("/skus", ROUGH))

    refused = problem(small_plant.post("/skus/rough/refine", {"run_id": run_id}), 422, "validation-failed")

    assert "'tiny'" in refused["detail"]
    problem(small_plant.post("/skus/tiny/refine", {"run_id": str(uuid4())}), 404, "not-found")


def test_a_run_without_a_result_refines_nothing(small_plant: Plant) -> None:
    small_plant.publish_sku()
    problem(small_plant.post("/skus/tiny/refine", {"run_id": small_plant.open_run()}), 404, "not-found")


@pytest.mark.parametrize("hfov_deg", [0, 180, 400])
def test_an_impossible_field_of_view_is_refused_by_name(small_plant: Plant, hfov_deg: float) -> None:
    sheet = {**ROUGH, "nominal": {}, "data_sheet": {"hfov_deg": hfov_deg}}
    refused = problem(small_plant.post("/skus", sheet), 422, "validation-failed")
    assert "hfov_deg" in str(refused) or "field of view" in str(refused)
