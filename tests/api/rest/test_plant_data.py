"""Targets, stations, keys, vehicles and health: the small resources."""

from uuid import uuid4

from service.storage.words import Role
from tests.plant import Plant, problem


def test_a_board_is_registered_once(plant: Plant) -> None:
    made = plant.expect(201, plant.post("/targets", {"serial": "B-1", "spec": "chessboard:9x6:25.0mm"}))

    assert made["spec"] == "chessboard:9x6:25mm"
    assert plant.get("/targets").json()["items"] == [made]
    problem(plant.post("/targets", {"serial": "B-1", "spec": "chessboard:9x6:25mm"}), 409, "already-exists")
    problem(plant.post("/targets", {"serial": "B-2", "spec": "paper"}), 422, "target-spec-invalid")


def test_a_station_has_a_board_and_its_runs_name_it(plant: Plant) -> None:
    board = plant.post("/targets", {"spec": "chessboard:9x6:25mm"}).json()["id"]
    body = {"code": "cal1", "name": "Calibration 1", "target_id": board}

    made = plant.expect(201, plant.post("/stations", body))

    assert plant.get("/stations").json()["items"] == [made]
    problem(plant.post("/stations", body), 409, "already-exists")
    problem(plant.post("/stations", {**body, "code": "cal2", "target_id": str(uuid4())}), 404, "not-found")
    plant.publish_sku()
    run_id = plant.open_run(station="cal1")
    assert plant.get(f"/runs/{run_id}").json()["station"] == "cal1"


def test_a_new_key_works_until_it_is_revoked(plant: Plant) -> None:
    made = plant.expect(201, plant.post("/keys", {"name": "kiosk 1", "role": "operator"}))
    header = {"Authorization": f"Bearer {made['key']}"}
    assert plant.client.get("/api/v1/runs", headers=header).status_code == 200

    plant.expect(200, plant.post(f"/keys/{made['id']}/revoke"))

    problem(plant.client.get("/api/v1/runs", headers=header), 401, "not-authenticated")
    listed = plant.get("/keys", role=Role.ADMIN)
    assert made["key"] not in listed.text
    assert {key["name"]: key["revoked_at"] is None for key in listed.json()["items"]}["kiosk 1"] is False
    problem(plant.post(f"/keys/{uuid4()}/revoke"), 404, "not-found")


def test_a_key_of_any_role_reads_whose_it_is_and_what_it_may(small_plant: Plant) -> None:
    for role in Role:
        own = small_plant.expect(200, small_plant.get("/keys/own", role=role))
        assert (own["name"], own["role"]) == (role.value, role.value)
        assert "key" not in own


def test_a_vehicle_has_a_history_and_a_latest_result(plant: Plant) -> None:
    plant.publish_sku()
    first = plant.finished_run("VIN-1")
    retest = plant.open_run("VIN-1", purpose="retest")
    plant.open_run("VIN-2")

    vehicle = plant.expect(200, plant.get("/vehicles/VIN-1"))

    assert [run["id"] for run in vehicle["runs"]] == [retest, first]
    assert vehicle["latest_result"] == plant.get(f"/runs/{first}/result").json()
    assert plant.get("/vehicles/VIN-2").json()["latest_result"] is None
    problem(plant.get("/vehicles/VIN-3"), 404, "not-found")
    problem(plant.get("/vehicles/VIN*"), 422, "serial-invalid")


def test_a_healthy_service_lives_and_is_ready(plant: Plant) -> None:
    assert plant.client.get("/livez").json() == {"status": "alive"}
    assert plant.client.get("/readyz").json()["checks"] == ["database", "schema", "images", "jobs"]


def test_a_service_whose_jobs_stand_still_is_not_ready_but_lives(small_plant: Plant) -> None:
    small_plant.app.state.services.jobs.stop(5.0)

    problem(small_plant.client.get("/readyz"), 503, "unavailable")
    assert small_plant.client.get("/livez").status_code == 200
