from typing import Any
from uuid import uuid4

import pytest

from service.storage.models import AuditEntryRow, CalibrationRow, OutboxEventRow
from service.storage.words import Role
from tests.plant import SKU, Plant, pose_set, poses_json, problem, revision


def test_a_run_goes_from_its_serial_to_a_verdict(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run("VIN-1")

    run = plant.expect(200, plant.get(f"/runs/{run_id}"))

    assert (run["state"], run["outcome"], run["verdict"]) == ("finished", "COMPLETED", "PASS")
    assert run["captures"] == run["poses"] == len(run["capture_list"]) == len(pose_set().poses)
    result = run["result"]
    for name in ("fx", "fy", "cx", "cy"):
        assert (
            abs(result["intrinsics"][name] - revision().intrinsics.parameters[name]) < 4 * result["sd"][name]
        )
    assert {view["capture_id"] for view in result["views"]} == {c["id"] for c in run["capture_list"]}
    assert {"fit", "certainty", "poses", "frame"} <= {gate["gate"] for gate in result["gates"]}
    assert result == plant.expect(200, plant.get(f"/runs/{run_id}/result"))


def test_a_finished_run_leaves_an_event_and_a_trail(plant: Plant) -> None:
    plant.publish_sku()
    plant.finished_run("VIN-7")

    with plant.app.state.services.database.read() as session:
        event = session.query(OutboxEventRow).one()
        actions = {row.action for row in session.query(AuditEntryRow)}

    assert (event.kind, event.subject, event.body["verdict"]) == ("run.finished", "vehicle:VIN-7", "PASS")
    assert {
        "sku.create",
        "sku.publish",
        "pose-set.import",
        "run.open",
        "capture.add",
        "run.finish",
    } <= actions


def test_a_second_finish_names_the_first_result(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run()

    refused = problem(plant.finish(run_id), 409, "run-already-finished")

    assert plant.client.get(refused["facts"]["result"]).status_code == 401
    assert plant.get(refused["facts"]["result"].removeprefix("/api/v1")).json()["verdict"] == "PASS"
    with plant.app.state.services.database.read() as session:
        assert session.query(CalibrationRow).count() == 1


def test_too_few_views_leave_the_run_open(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()
    small_plant.upload(run_id, 0)
    small_plant.upload(run_id, 1)

    facts = problem(small_plant.finish(run_id), 422, "too-few-views")["facts"]

    assert facts["views_found"] == 2
    assert small_plant.get(f"/runs/{run_id}").json()["state"] == "open"
    assert small_plant.upload(run_id, 2).status_code == 201


def test_an_aborted_run_takes_nothing_more(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()

    aborted = small_plant.expect(200, small_plant.post(f"/runs/{run_id}/abort", role=Role.OPERATOR))

    assert (aborted["state"], aborted["outcome"], aborted["verdict"]) == ("aborted", "ABORTED", None)
    problem(small_plant.upload(run_id, 0), 409, "run-aborted")
    problem(small_plant.finish(run_id), 409, "run-aborted")
    problem(small_plant.post(f"/runs/{run_id}/abort"), 409, "run-aborted")
    problem(small_plant.get(f"/runs/{run_id}/result"), 404, "not-found")


def test_a_run_needs_a_published_revision(small_plant: Plant) -> None:
    small_plant.post("/skus", SKU)

    problem(small_plant.post("/runs", {"sku": "tiny", "serial": "A"}), 409, "revision-not-published")


def test_a_production_run_needs_a_published_pose_set_and_a_trial_does_not(small_plant: Plant) -> None:
    small_plant.publish_sku(with_poses=False)

    problem(small_plant.post("/runs", {"sku": "tiny", "serial": "A"}), 409, "pose-set-not-published")
    assert small_plant.get("/runs").json()["items"] == []
    small_plant.open_run("A", purpose="trial")


@pytest.mark.parametrize("body", [{"sku": "none"}, {"station": "none"}])
def test_a_run_on_something_unknown_is_refused(small_plant: Plant, body: dict[str, str]) -> None:
    small_plant.publish_sku()

    problem(small_plant.post("/runs", {"sku": "tiny", "serial": "A", **body}), 404, "not-found")


@pytest.mark.parametrize(
    "serial", ["", "   ", "A\tB", "A\u0000B", "A*", "50%", "VIN_1", "[1]", "x" * 65, "A\u200bB"]
)
def test_a_serial_that_other_systems_cannot_carry_is_refused(small_plant: Plant, serial: str) -> None:
    small_plant.publish_sku()

    problem(small_plant.post("/runs", {"sku": "tiny", "serial": serial}), 422, "serial-invalid")


def test_serials_are_stripped_and_compared_exactly(small_plant: Plant) -> None:
    small_plant.publish_sku()
    small_plant.open_run(" Vin-1 ")

    assert small_plant.get("/vehicles/Vin-1").json()["serial"] == "Vin-1"
    problem(small_plant.get("/vehicles/VIN-1"), 404, "not-found")


def test_the_same_request_with_the_same_key_opens_one_run(plant: Plant) -> None:
    plant.publish_sku()
    body, key = {"sku": "tiny", "serial": "VIN-1"}, {"Idempotency-Key": "order-1"}

    first = plant.post("/runs", body, headers=key)
    plant.post(f"/runs/{first.json()['id']}/abort")
    again = plant.post("/runs", body, headers=key)

    assert (first.status_code, again.status_code) == (201, 201)
    assert again.json() == first.json()
    assert again.headers["Idempotency-Replayed"] == "true"
    assert "Idempotency-Replayed" not in first.headers
    assert len(plant.get("/runs").json()["items"]) == 1


def test_another_request_with_the_same_key_is_refused(plant: Plant) -> None:
    plant.publish_sku()
    plant.post("/runs", {"sku": "tiny", "serial": "VIN-1"}, headers={"Idempotency-Key": "k"})

    other = plant.post("/runs", {"sku": "tiny", "serial": "VIN-2"}, headers={"Idempotency-Key": "k"})

    problem(other, 422, "idempotency-key-reused")
    assert len(plant.get("/runs").json()["items"]) == 1


def test_a_refused_request_does_not_use_up_its_key(small_plant: Plant) -> None:
    body, key = {"sku": "tiny", "serial": "VIN-1"}, {"Idempotency-Key": "k"}
    problem(small_plant.post("/runs", body, headers=key), 404, "not-found")
    small_plant.publish_sku()

    assert small_plant.post("/runs", body, headers=key).status_code == 201


def test_keys_of_two_callers_do_not_meet(small_plant: Plant) -> None:
    small_plant.publish_sku()
    body, key = {"sku": "tiny", "serial": "VIN-1"}, {"Idempotency-Key": "k"}

    one = small_plant.post("/runs", body, role=Role.MES, headers=key)
    other = small_plant.post("/runs", body, role=Role.OPERATOR, headers=key)

    assert one.json()["id"] != other.json()["id"]


def test_a_list_comes_in_parts_that_miss_and_repeat_nothing(plant: Plant) -> None:
    plant.publish_sku()
    ids = [plant.open_run(f"VIN-{n}") for n in range(5)]

    part = plant.expect(200, plant.get("/runs?limit=2"))
    seen = [run["id"] for run in part["items"]]
    while part["next_cursor"]:
        part = plant.expect(200, plant.get(f"/runs?limit=2&cursor={part['next_cursor']}"))
        seen += [run["id"] for run in part["items"]]

    assert seen == ids[::-1]
    assert [run["serial"] for run in plant.get("/runs?serial=VIN-3").json()["items"]] == ["VIN-3"]


@pytest.mark.parametrize("cursor", ["x", "AAAA", "MjAyNi0wMS0wMXwx", "\u00e4"])
def test_a_cursor_from_elsewhere_is_refused(small_plant: Plant, cursor: str) -> None:
    problem(small_plant.get("/runs", params={"cursor": cursor}), 400, "cursor-invalid")


def test_an_unknown_run_is_not_found(small_plant: Plant) -> None:
    for method, path in (("GET", ""), ("GET", "/result"), ("POST", "/finish"), ("POST", "/abort")):
        problem(small_plant.call(method, f"/runs/{uuid4()}{path}"), 404, "not-found")
    problem(small_plant.send(str(uuid4()), b"x"), 404, "not-found")


def test_pictures_of_another_vehicle_fail_unless_they_are_replayed_on_purpose(small_plant: Plant) -> None:
    small_plant.publish_sku()
    small_plant.finished_run("VIN-1")
    again = small_plant.get(f"/runs/{small_plant.finished_run('VIN-1')}/result").json()
    swapped = small_plant.get(f"/runs/{small_plant.finished_run('VIN-2')}/result").json()

    def used(result: dict[str, Any]) -> dict[str, Any]:
        return next(gate for gate in result["gates"] if gate["name"] == "used_elsewhere")

    assert (swapped["verdict"], used(swapped)["verdict"]) == ("FAIL", "FAIL")
    assert "VIN-1" in used(swapped)["advice"]
    assert used(again)["verdict"] == "PASS"


def test_simulated_runs_may_show_the_same_pictures_for_every_vehicle(small_plant: Plant) -> None:
    small_plant.publish_sku()
    small_plant.finished_run("VIN-1")
    run_id = small_plant.open_run("VIN-2", purpose="simulated")
    for index in range(len(poses_json())):
        small_plant.upload(run_id, index)

    assert small_plant.finish(run_id).json()["verdict"] == "PASS"
