"""Certificates over REST: signed at the finish, always the same bytes, checkable by the open keys."""

import hashlib
import json
import re
from datetime import timedelta
from pathlib import Path
from uuid import UUID

import pytest
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from sqlalchemy import delete, select

from service.adapters.signing_keys_files import add_signing_key
from service.core.errors import DiskFull
from service.storage.models import AuditEntryRow, CaptureRow, CertificateRow
from service.usecases.canonical_json import canonical_json
from service.usecases.certificate import Genuine, check_certificate, read_certificate
from service.usecases.finish import recompute
from service.usecases.signing import KeyRing, read_key_set
from tests.plant import Plant, pose_set, problem, running_plant
from tests.rules.test_commit import failing_commits


def certificate(plant: Plant, run_id: str) -> bytes:
    answer = plant.get(f"/runs/{run_id}/certificate")
    assert answer.status_code == 200, answer.text
    return answer.content


def checked(plant: Plant, token: bytes) -> Genuine:
    answer = plant.client.get("/.well-known/jwks.json")
    assert answer.status_code == 200
    return check_certificate(token, read_key_set(answer.content))


def test_a_certificate_says_what_the_result_says(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run("VIN-7")
    result = plant.get(f"/runs/{run_id}/result").json()
    run = plant.get(f"/runs/{run_id}").json()

    found = checked(plant, certificate(plant, run_id))

    content = found.content
    told = content["run"]
    assert (content["verdict"], told["serial"], told["id"]) == (result["verdict"], "VIN-7", run_id)
    assert (told["sku"], told["revision"], told["station"]) == ("tiny", 1, None)
    assert (told["purpose"], told["opened_at"]) == ("production", run["created_at"])
    assert told["finished_at"] == content["issued_at"] == run["finished_at"]
    assert content["result"]["intrinsics"] == result["intrinsics"]
    assert content["result"]["sd"] == pytest.approx(result["sd"])
    assert content["result"]["mapping"] == result["mapping"]
    assert [one["name"] for one in content["measurements"]] == [gate["name"] for gate in result["gates"]]
    assert [one["sha256"] for one in content["images"]] == [one["sha256"] for one in run["capture_list"]]
    assert content["versions"] == result["versions"]
    with plant.app.state.services.database.read() as session:
        document = recompute(session, UUID(run_id))
    assert content["result"]["sha256"] == hashlib.sha256(canonical_json(document)).hexdigest()


def test_a_certificate_is_always_the_same_bytes(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.finished_run()
    first = certificate(small_plant, run_id)
    services = small_plant.app.state.services
    other = KeyRing.of(Ed25519PrivateKey.generate())
    later = services.clock.now() + timedelta(days=9)

    again = read_certificate(services.database, other, UUID(run_id), "auditor", later)

    assert certificate(small_plant, run_id) == first == again.token.encode()


def test_a_certificate_has_a_type_and_a_name(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.finished_run("VIN 8/ä")

    answer = small_plant.get(f"/runs/{run_id}/certificate")

    assert answer.headers["content-type"] == "application/jose"
    said = answer.headers["content-disposition"]
    assert re.search(r'filename="VIN_8__-\d{8}T\d{6}Z-certificate.jws"', said)
    assert "filename*=UTF-8''VIN_8_%C3%A4-" in said


def test_a_camera_that_failed_has_a_certificate_that_says_fail(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()
    count = len(pose_set().poses)
    for told in range(count):
        small_plant.expect(201, small_plant.upload_as(run_id, shown=count - 1 - told, told=told))
    assert small_plant.finish(run_id).json()["verdict"] == "FAIL"

    assert checked(small_plant, certificate(small_plant, run_id)).content["verdict"] == "FAIL"


def test_without_a_result_there_is_no_certificate(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()

    problem(small_plant.get(f"/runs/{run_id}/certificate"), 404, "not-found")
    problem(small_plant.get(f"/runs/{UUID(int=1)}/certificate"), 404, "not-found")


def test_a_result_whose_commit_fails_leaves_no_certificate(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.open_run()
    for index in range(len(pose_set().poses)):
        plant.upload(run_id, index)

    with failing_commits(plant, DiskFull("No room left on it.")):
        problem(plant.finish(run_id), 503, "disk-full")

    with plant.app.state.services.database.read() as session:
        assert session.scalars(select(CertificateRow)).all() == []


def test_a_result_of_before_gets_its_certificate_when_it_is_asked_for(plant: Plant) -> None:
    plant.publish_sku()
    run_id = plant.finished_run()
    database = plant.app.state.services.database
    with database.write() as session:
        session.execute(delete(CertificateRow))

    first = certificate(plant, run_id)

    content = checked(plant, first).content
    assert content["issued_at"] > content["run"]["finished_at"]
    assert certificate(plant, run_id) == first
    with database.read() as session:
        issued = select(AuditEntryRow).where(AuditEntryRow.action == "certificate.issue")
        found = session.scalars(issued.order_by(AuditEntryRow.at))
        assert [entry.who for entry in found] == ["operator", "viewer"]


def test_certificates_are_checkable_after_the_keys_were_rotated(sqlite_address: str, tmp_path: Path) -> None:
    with running_plant(sqlite_address, tmp_path) as plant:
        plant.publish_sku()
        run_id = plant.finished_run()
        token = certificate(plant, run_id)
    keys = tmp_path / "signing-keys"
    add_signing_key(keys)

    with running_plant(sqlite_address, tmp_path) as plant:
        published = plant.client.get("/.well-known/jwks.json")
        assert checked(plant, token).key_id == published.json()["keys"][1]["kid"]
        newer = checked(plant, certificate(plant, plant.finished_run("VIN-2")))

    assert newer.key_id == published.json()["keys"][0]["kid"]
    assert published.headers["cache-control"] == "public, max-age=300"
    assert json.loads(published.text)["keys"][0].keys() == {"kty", "crv", "x", "kid", "alg", "use"}


def test_images_are_told_by_the_numbers_of_their_captures(small_plant: Plant) -> None:
    small_plant.publish_sku()
    run_id = small_plant.open_run()
    count = len(pose_set().poses)
    for index in range(count):
        small_plant.expect(201, small_plant.upload(run_id, index))
    captures = small_plant.get(f"/runs/{run_id}").json()["capture_list"]
    small_plant.call("DELETE", f"/runs/{run_id}/captures/{captures[2]['id']}")
    small_plant.expect(201, small_plant.upload(run_id, 2))
    small_plant.expect(200, small_plant.finish(run_id))

    content = checked(small_plant, certificate(small_plant, run_id)).content

    with small_plant.app.state.services.database.read() as session:
        stored = session.execute(select(CaptureRow.number, CaptureRow.sha256).order_by(CaptureRow.number))
        assert [(one["number"], one["sha256"]) for one in content["images"]] == [tuple(row) for row in stored]
