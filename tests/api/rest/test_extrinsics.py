"""The camera's place in the vehicle over REST: the station's fixture, a picture of it, the result."""

from typing import Any
from uuid import UUID

import numpy as np
import pytest
from sqlalchemy import select

from service.core.vision.transforms import Pose, compose, invert, rotation_matrix, rotation_vector
from service.storage.models import CalibrationRow
from service.usecases.finish import recompute
from tests.plant import Plant, encode, pose_set, problem, revision, shown_at

FIXTURE: dict[str, Any] = {
    "target": "chessboard:7x5:30mm",
    "pose": {"rvec": [0.1, 1.5, 0.3], "tvec": [1.5, 0.2, 1.0]},
    "translation_sd_mm": 0.2,
    "rotation_sd_mdeg": 20.0,
}
TURN = rotation_matrix(np.array([0.3, -0.25, 0.05]))
SEEN = Pose(rotation_vector(TURN), np.array([0.01, 0.0, 0.55]) - TURN @ revision().target.centre)
T_VEHICLE_CAM = compose(
    Pose(np.array(FIXTURE["pose"]["rvec"]), np.array(FIXTURE["pose"]["tvec"])), invert(SEEN)
)
PICTURE = encode(shown_at(SEEN, 77))


def station(plant: Plant, fixture: dict[str, Any] | None = FIXTURE) -> None:
    plant.expect(201, plant.post("/stations", {"code": "cal1", "name": "One", "fixture": fixture}))


def send(plant: Plant, run_id: str, content: bytes = PICTURE, query: str = "role=extrinsics") -> Any:
    headers = {"Content-Type": "image/png"}
    return plant.call("POST", f"/runs/{run_id}/captures?{query}", content=content, headers=headers)


def pose_json(pose: Pose) -> dict[str, Any]:
    return {"rvec": pose.rvec.tolist(), "tvec": pose.tvec.tolist()}


def taken_run(plant: Plant) -> str:
    """Return an open run with its poses taken, at a station with a fixture."""
    plant.publish_sku(mounting=pose_json(T_VEHICLE_CAM))
    station(plant)
    run_id = plant.open_run(station="cal1")
    for index in range(len(pose_set().poses)):
        plant.expect(201, plant.upload(run_id, index))
    return run_id


@pytest.fixture
def run_id(plant: Plant) -> str:
    """An open run with its poses taken, at a station with a fixture."""
    return taken_run(plant)


def test_a_picture_of_the_fixed_target_gives_the_place_in_the_vehicle(plant: Plant, run_id: str) -> None:
    capture = plant.expect(201, send(plant, run_id))
    again = plant.expect(200, send(plant, run_id))
    result = plant.expect(200, plant.finish(run_id))

    found = result["extrinsics"]
    off_mm = 1000 * (np.array(found["pose"]["tvec"]) - T_VEHICLE_CAM.tvec)
    assert (capture["role"], capture["pose_index"], again["id"]) == ("extrinsics", None, capture["id"])
    assert np.all(np.abs(off_mm) < 3 * np.array(found["translation_sd_mm"]))
    assert found["fixture"] == FIXTURE
    assert np.array(found["covariance"]).shape == (6, 6)
    assert {gate["name"] for gate in result["gates"] if gate["gate"] == "extrinsics"} >= {
        "translation_sd_mm",
        "rotation_sd_mdeg",
        "mounting_off_mm",
        "mounting_off_mdeg",
    }
    assert result["verdict"] == "PASS"
    shown = plant.get(f"/captures/{capture['id']}").json()
    assert shown["rms_px"] == pytest.approx(found["rms_px"])


def test_a_result_keeps_the_fixture_that_it_was_made_with(plant: Plant, run_id: str) -> None:
    plant.expect(201, send(plant, run_id))
    result = plant.expect(200, plant.finish(run_id))
    other = {**FIXTURE, "pose": {"rvec": [0.0, 0.0, 0.0], "tvec": [9.0, 9.0, 9.0]}}

    plant.expect(200, plant.call("PATCH", "/stations/cal1", json={"fixture": other}))

    assert plant.get(f"/runs/{run_id}/result").json() == result
    with plant.app.state.services.database.read() as session:
        stored = session.scalars(select(CalibrationRow)).one()
        assert recompute(session, UUID(run_id)) == stored.document


def test_pictures_before_and_after_a_change_of_the_fixture_are_not_mixed(plant: Plant, run_id: str) -> None:
    plant.expect(201, send(plant, run_id))
    moved = {**FIXTURE, "translation_sd_mm": 0.5}
    changed = plant.expect(200, plant.call("PATCH", "/stations/cal1", json={"fixture": moved}))

    assert changed["fixture"] == moved
    problem(send(plant, run_id, encode(shown_at(SEEN, 78))), 409, "fixture-changed")


def test_what_cannot_be_a_picture_of_the_fixed_target_is_refused(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant, fixture=None)
    at_station, without = small_plant.open_run(station="cal1"), small_plant.open_run("VIN-2")
    problem(send(small_plant, at_station), 409, "fixture-missing")
    problem(send(small_plant, without), 409, "fixture-missing")
    small_plant.expect(200, small_plant.call("PATCH", "/stations/cal1", json={"fixture": FIXTURE}))
    problem(send(small_plant, at_station, query="role=extrinsics&pose_index=0"), 422, "validation-failed")
    problem(send(small_plant, at_station, query="role=else"), 422, "validation-failed")
    small_plant.expect(201, send(small_plant, at_station))
    problem(send(small_plant, at_station, query="role=intrinsics"), 409, "duplicate-image")
    problem(small_plant.finish(at_station), 422, "too-few-views")


@pytest.mark.parametrize(
    "wrong",
    [
        {"target": "nonsense"},
        {"translation_sd_mm": -1.0},
        {"pose": {"rvec": [0.0, 0.0], "tvec": [0.0, 0.0, 0.0]}},
        {"surprise": 1},
    ],
)
def test_a_fixture_that_cannot_be_is_refused_by_field(small_plant: Plant, wrong: dict[str, Any]) -> None:
    answer = small_plant.post("/stations", {"code": "cal1", "name": "One", "fixture": {**FIXTURE, **wrong}})
    told = problem(answer, 422, "validation-failed")
    assert "fixture" in str(told["errors"])
