"""Extrinsics after the run, over REST: stored intrinsics and pictures of a fixed target alone."""

import struct
from typing import Any
from uuid import UUID

import cv2
import numpy as np
import pytest
from sqlalchemy import select

from service.core.vision.transforms import Pose
from service.storage.models import CalibrationRow, CaptureRow, OutboxEventRow, RunRow
from service.storage.placed import LaterCertificateRow, LaterExtrinsicsRow
from service.storage.words import Role
from service.usecases.certificate import check_certificate
from service.usecases.later_extrinsics import recompute_later
from service.usecases.signing import read_key_set
from tests.api.rest.test_extrinsics import (
    FIXTURE,
    PICTURE,
    SEEN,
    T_VEHICLE_CAM,
    pose_json,
    station,
    taken_run,
)
from tests.plant import JsonObject, Plant, encode, pose_set, problem, shown_at

MORE = tuple(encode(shown_at(SEEN, seed)) for seed in (78, 79))


def measure(plant: Plant, run_id: str, *pictures: bytes, at: str = "cal1", role: Role = Role.OPERATOR) -> Any:
    """Send pictures of the fixed target for a finished run."""
    files = [("image", (f"{i}.png", content, "image/png")) for i, content in enumerate(pictures)]
    return plant.call("POST", f"/runs/{run_id}/extrinsics?station={at}", role, files=files)


def with_verdict(plant: Plant, run_id: str, verdict: str) -> None:
    """Give a finished run another verdict."""
    with plant.app.state.services.database.write() as session:
        session.get_one(RunRow, UUID(run_id)).verdict = verdict


@pytest.fixture
def run_id(plant: Plant) -> str:
    """A finished run without extrinsics; another station has a fixture."""
    plant.publish_sku(mounting=pose_json(T_VEHICLE_CAM))
    station(plant)
    return plant.finished_run("VIN-1")


def test_pictures_of_a_fixed_target_alone_give_the_place_in_the_vehicle(plant: Plant, run_id: str) -> None:
    before = plant.get(f"/runs/{run_id}/result").json()

    made = plant.expect(201, measure(plant, run_id, PICTURE))

    found = made["extrinsics"]
    off_mm = 1000 * (np.array(found["pose"]["tvec"]) - T_VEHICLE_CAM.tvec)
    assert np.all(np.abs(off_mm) < 3 * np.array(found["translation_sd_mm"]))
    assert (made["verdict"], made["serial"], made["station"]) == ("PASS", "VIN-1", "cal1")
    assert found["fixture"] == FIXTURE
    assert {gate["gate"] for gate in made["gates"]} == {"extrinsics"}
    assert "mounting_off_mm" in {gate["name"] for gate in made["gates"]}
    assert plant.get(f"/runs/{run_id}/result").json() == before
    assert plant.get(f"/extrinsics/{made['id']}").json() == made
    assert plant.get(f"/runs/{run_id}/extrinsics").json()["items"] == [made]
    assert plant.get(made["pictures"][0]["image_url"].removeprefix("/api/v1")).content == PICTURE
    with plant.app.state.services.database.read() as session:
        stored = session.scalars(select(LaterExtrinsicsRow)).one()
        assert recompute_later(session, stored.id) == stored.document
        kinds = list(session.scalars(select(OutboxEventRow.kind)))
        assert kinds.count("extrinsics.measured") == 1


def test_what_is_measured_after_the_run_has_a_certificate_of_its_own(plant: Plant, run_id: str) -> None:
    of_run = plant.get(f"/runs/{run_id}/certificate").content
    made = plant.expect(201, measure(plant, run_id, PICTURE))
    path = f"/extrinsics/{made['id']}/certificate"
    answer = plant.get(path)

    content = genuine(plant, answer.content)

    told = content["extrinsics"]
    assert (content["verdict"], content["run"]["serial"], told["station"]) == ("PASS", "VIN-1", "cal1")
    assert (told["pose"], told["fixture"]) == (made["extrinsics"]["pose"], FIXTURE)
    assert told["covariance"] == made["extrinsics"]["covariance"]
    assert content["result"]["sha256"] == genuine(plant, of_run)["result"]["sha256"]
    assert [one["name"] for one in content["measurements"]] == [gate["name"] for gate in made["gates"]]
    assert [one["sha256"] for one in content["images"]] == [one["sha256"] for one in made["pictures"]]
    assert answer.headers["content-type"] == "application/jose"
    assert f"VIN-1-{content['run']['finished_at'][:4]}" in answer.headers["content-disposition"]
    assert plant.get(f"/runs/{run_id}/certificate").content == of_run
    with plant.app.state.services.database.write() as session:
        row = session.scalars(select(LaterCertificateRow)).one()
        assert row.token.encode() == answer.content == plant.get(path).content
        # As of a measurement from before there were such certificates.
        session.delete(row)
    again = genuine(plant, plant.get(path).content)
    assert {**again, "issued_at": ""} == {**content, "issued_at": ""}
    problem(plant.get(f"/extrinsics/{run_id}/certificate"), 404, "not-found")


def genuine(plant: Plant, token: bytes) -> JsonObject:
    """Return what a certificate says, checked by the open keys."""
    return check_certificate(token, read_key_set(plant.client.get("/.well-known/jwks.json").content)).content


def test_exports_give_away_the_newest_place_that_did_not_fail(small_plant: Plant) -> None:
    """The run's own first, then what was measured after it; never one that failed."""
    small_plant.publish_sku(
        block_layout={
            "name": "place",
            "version": 1,
            "size": 24,
            "fields": [
                {"name": axis, "type": "f64", "source": f"extrinsics.{axis}_m"} for axis in ("x", "y", "z")
            ],
            "crc": None,
        }
    )
    station(small_plant)
    run_id = small_plant.finished_run()
    path = f"/runs/{run_id}/exports/block"
    problem(small_plant.get(path), 422, "block-layout-unusable")
    shifted = Pose(SEEN.rvec, SEEN.tvec + np.array([0.02, 0.0, 0.0]))
    failed = small_plant.expect(201, measure(small_plant, run_id, PICTURE, encode(shown_at(shifted, 80))))
    assert failed["verdict"] == "FAIL"
    problem(small_plant.get(path), 422, "block-layout-unusable")

    found = small_plant.expect(201, measure(small_plant, run_id, PICTURE))

    assert struct.unpack("<3d", small_plant.get(path).content) == tuple(found["extrinsics"]["pose"]["tvec"])
    newer = small_plant.expect(201, measure(small_plant, run_id, *MORE))["extrinsics"]["pose"]["tvec"]
    assert struct.unpack("<3d", small_plant.get(path).content) == tuple(newer)
    written = cv2.FileStorage(
        small_plant.get(f"/runs/{run_id}/exports/opencv").text,
        cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY,
    )
    assert written.getNode("T_vehicle_cam").mat()[:3, 3].tolist() == newer


def test_it_is_what_the_run_itself_would_have_found(small_plant: Plant) -> None:
    """The same picture within the run and after it: one estimate, one covariance."""
    run_id = taken_run(small_plant)
    headers = {"Content-Type": "image/png"}
    path = f"/runs/{run_id}/captures?role=extrinsics"
    small_plant.expect(201, small_plant.call("POST", path, content=PICTURE, headers=headers))
    within = small_plant.expect(200, small_plant.finish(run_id))["extrinsics"]

    certified = genuine(small_plant, small_plant.get(f"/runs/{run_id}/certificate").content)

    after = small_plant.expect(201, measure(small_plant, run_id, PICTURE))["extrinsics"]

    assert certified["result"]["extrinsics"]["pose"] == within["pose"]
    assert certified["result"]["extrinsics"]["covariance"] == within["covariance"]

    assert after["pose"]["tvec"] == pytest.approx(within["pose"]["tvec"], abs=1e-12)
    np.testing.assert_allclose(after["covariance"], within["covariance"], rtol=1e-9)
    assert after["parts"]["intrinsics"]["translation_sd_mm"] > 0


def test_the_covariance_of_the_stored_intrinsics_counts(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    other = {"code": "cal2", "name": "Two", "fixture": FIXTURE}
    small_plant.expect(201, small_plant.post("/stations", other))
    run_id = small_plant.finished_run()
    known = small_plant.expect(201, measure(small_plant, run_id, PICTURE))["extrinsics"]["parts"]
    with small_plant.app.state.services.database.write() as session:
        row = session.scalars(select(CalibrationRow)).one()
        row.covariance = (4 * np.array(row.covariance)).tolist()

    doubted = small_plant.expect(201, measure(small_plant, run_id, PICTURE, at="cal2"))["extrinsics"]["parts"]

    for name, times in (("intrinsics", 2.0), ("noise", 1.0), ("fixture", 1.0)):
        for sd in ("translation_sd_mm", "rotation_sd_mdeg"):
            assert doubted[name][sd] == pytest.approx(times * known[name][sd])


def test_several_pictures_must_agree(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    run_id = small_plant.finished_run()
    three = small_plant.expect(201, measure(small_plant, run_id, PICTURE, *MORE))
    shifted = Pose(SEEN.rvec, SEEN.tvec + np.array([0.02, 0.0, 0.0]))

    moved = small_plant.expect(201, measure(small_plant, run_id, PICTURE, encode(shown_at(shifted, 80))))

    assert len(three["extrinsics"]["views"]) == 3
    assert three["extrinsics"]["image_agreement_px"] < 0.3
    failed = {gate["name"] for gate in moved["gates"] if gate["verdict"] == "FAIL"}
    assert (moved["verdict"], "image_agreement_px" in failed) == ("FAIL", True)


def test_the_same_pictures_are_measured_once(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    run_id = small_plant.finished_run()
    first = small_plant.expect(201, measure(small_plant, run_id, PICTURE, MORE[0]))

    again = small_plant.expect(200, measure(small_plant, run_id, MORE[0], PICTURE))

    assert again == first
    moved = {**FIXTURE, "translation_sd_mm": 0.5}
    small_plant.expect(200, small_plant.call("PATCH", "/stations/cal1", json={"fixture": moved}))
    assert small_plant.get(f"/extrinsics/{first['id']}").json() == first
    other = small_plant.expect(201, measure(small_plant, run_id, PICTURE, MORE[0]))
    assert other["extrinsics"]["fixture"] == moved
    listed = small_plant.get(f"/runs/{run_id}/extrinsics").json()["items"]
    assert [one["id"] for one in listed] == [other["id"], first["id"]]


def test_only_the_newest_accepted_result_of_a_serial_is_used(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    open_id = small_plant.open_run("VIN-1")
    problem(measure(small_plant, open_id, PICTURE), 404, "not-found")
    first = small_plant.finished_run("VIN-1")
    with_verdict(small_plant, first, "FAIL")
    problem(measure(small_plant, first, PICTURE), 409, "result-not-usable")
    with_verdict(small_plant, first, "MARGINAL")
    small_plant.expect(201, measure(small_plant, first, PICTURE))

    newer = reopened(small_plant, "VIN-1")

    refused = problem(measure(small_plant, first, MORE[0]), 409, "result-not-usable")
    assert refused["facts"] == {"run": f"/api/v1/runs/{newer}"}
    # What was measured before stays an answer.
    small_plant.expect(200, measure(small_plant, first, PICTURE))
    small_plant.expect(201, measure(small_plant, newer, MORE[0]))


def reopened(plant: Plant, serial: str) -> str:
    """Calibrate a serial once more."""
    run_id = plant.open_run(serial, purpose="retest")
    for index in range(len(pose_set().poses)):
        plant.expect(201, plant.upload(run_id, index))
    plant.expect(200, plant.finish(run_id))
    return run_id


def test_what_cannot_be_measured_is_refused(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    small_plant.expect(201, small_plant.post("/stations", {"code": "bare", "name": "Bare"}))
    run_id = small_plant.finished_run("VIN-1")
    problem(measure(small_plant, run_id, PICTURE, at="bare"), 409, "fixture-missing")
    problem(measure(small_plant, run_id, PICTURE, at="nowhere"), 404, "not-found")
    problem(measure(small_plant, run_id, PICTURE, PICTURE), 409, "duplicate-image")
    problem(measure(small_plant, run_id, PICTURE, role=Role.VIEWER), 403, "role-missing")
    problem(
        measure(small_plant, run_id, encode(np.full((400, 640), 128, np.uint8))), 422, "target-not-visible"
    )
    problem(measure(small_plant, run_id, *[PICTURE] * 9), 400, "bad-request")
    headers = {"Content-Type": "image/png"}
    without = small_plant.call("POST", f"/runs/{run_id}/extrinsics", content=PICTURE, headers=headers)
    problem(without, 422, "validation-failed")
    assert small_plant.get(f"/runs/{run_id}/extrinsics").json()["items"] == []
    missing = small_plant.get("/extrinsics/019a2b3c-11aa-7bb2-9cc3-44dd55ee66ff")
    problem(missing, 404, "not-found")


def test_a_picture_is_of_one_vehicle_only(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    first, second = small_plant.finished_run("VIN-1"), finished_again(small_plant, "VIN-2")
    small_plant.expect(201, measure(small_plant, first, PICTURE))

    refused = problem(measure(small_plant, second, PICTURE), 409, "picture-of-another")

    assert refused["facts"] == {"serial": "VIN-1"}


def finished_again(plant: Plant, serial: str) -> str:
    """Calibrate another serial with the same corners under other hashes, whatever the gates say of it."""
    run_id = plant.finished_run(serial)
    with plant.app.state.services.database.write() as session:
        for i, row in enumerate(session.scalars(select(CaptureRow).where(CaptureRow.run_id == UUID(run_id)))):
            row.sha256 = f"{i:064x}"
    with_verdict(plant, run_id, "PASS")
    return run_id


def test_one_image_as_the_body_is_enough_and_other_routes_take_one_only(small_plant: Plant) -> None:
    small_plant.publish_sku()
    station(small_plant)
    run_id = small_plant.finished_run()
    path, headers = f"/runs/{run_id}/extrinsics?station=cal1", {"Content-Type": "image/png"}
    made: JsonObject = small_plant.expect(
        201, small_plant.call("POST", path, content=PICTURE, headers=headers)
    )
    assert [one["number"] for one in made["pictures"]] == [1]
    problem(small_plant.get(f"/extrinsics/{made['id']}/pictures/2"), 404, "not-found")
    files = [("image", ("a.png", PICTURE, "image/png")), ("image", ("b.png", MORE[0], "image/png"))]
    open_id = small_plant.open_run("VIN-9")
    problem(small_plant.call("POST", f"/runs/{open_id}/captures", files=files), 400, "bad-request")
