"""Whatever is sent, the answer is a problem document and never a fault of the service."""

import json
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.databases import sqlite_copy
from tests.plant import SKU, Plant, problem, running_plant

JSON = {"Content-Type": "application/json"}
POSTS = (
    "/skus",
    "/skus/tiny/revisions",
    "/skus/tiny/revisions/1/pose-sets",
    "/targets",
    "/stations",
    "/runs",
    "/keys",
)


@pytest.fixture(scope="module")
def small_plant(tmp_path_factory: pytest.TempPathFactory, migrated_sqlite: Any) -> Any:
    """One service for all of these: they change nothing."""
    directory = tmp_path_factory.mktemp("plant")
    with running_plant(sqlite_copy(migrated_sqlite, directory), directory) as plant:
        plant.publish_sku()
        plant.open_run()
        yield plant


@pytest.mark.parametrize("path", POSTS)
@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b'"x"',
        b"\xff\xfe",
        b"[" * 100_000,
        b'{"a":' * 5000,
        b"1" * 5000,
        b"{'a': 1}",
    ],
    ids=lambda content: repr(content[:12]),
)
def test_a_body_that_is_no_message_is_a_problem(small_plant: Plant, path: str, content: bytes) -> None:
    answer = small_plant.call("POST", path, content=content, headers=JSON)

    assert answer.status_code in {400, 422}
    problem(answer, answer.status_code, answer.json()["code"])


@pytest.mark.parametrize(
    "value", ["NaN", "Infinity", "-Infinity", "1e999", "9" * 400, '"\\u0000"', '"\\ud800"', "true"]
)
@pytest.mark.parametrize(
    "field", ["name", "nominal", "pose_count", "corner_noise_px", "target", "code", "limits"]
)
def test_a_value_that_no_database_can_hold_is_named(small_plant: Plant, field: str, value: str) -> None:
    text = json.dumps({**SKU, "code": "other", field: "@"}).replace('"@"', value)

    refused = problem(small_plant.call("POST", "/skus", content=text, headers=JSON), 422, "validation-failed")

    assert any(error["pointer"].startswith(f"/{field}") for error in refused["errors"])


@pytest.mark.parametrize("value", ["NaN", "1e999", '"\\u0000"', '"\\ud800"'])
def test_a_limit_that_is_no_number_is_refused(small_plant: Plant, value: str) -> None:
    for limits in ({"rms_px": "@"}, {"marginal": {"rms_px": "@"}}, {"marginal": "@"}):
        text = json.dumps({**SKU, "code": "other", "limits": limits}).replace('"@"', value)
        problem(small_plant.call("POST", "/skus", content=text, headers=JSON), 422, "validation-failed")


@pytest.mark.parametrize("key", ["", "a b", "x" * 201, "tab\there"])
def test_an_idempotency_key_that_is_none_is_refused(small_plant: Plant, key: str) -> None:
    answer = small_plant.post("/runs", {"sku": "tiny", "serial": "A"}, headers={"Idempotency-Key": key})

    assert (
        problem(answer, 422, "validation-failed")["errors"][0]["pointer"].lower() == "header/idempotency-key"
    )


@pytest.mark.parametrize(
    "path",
    ["/runs/x", "/runs/%00", "/vehicles/%00", "/skus/%00", "/skus/A%20B", "/runs?serial=%00", "/runs?limit=0",
     "/runs?limit=1e9", "/skus/tiny/revisions/0", "/skus/tiny/revisions/99999999999999999999", "/jobs/1",
     "/pose-sets/%ff", "/vehicles/..%2f..%2fetc", "/runs?serial=%ed%a0%80", "/nothing"],
)  # fmt: skip
def test_an_address_that_leads_nowhere_is_a_problem(small_plant: Plant, path: str) -> None:
    answer = small_plant.get(path)

    if not (path.startswith("/runs?serial") and answer.status_code == 200):
        assert 400 <= answer.status_code < 500, answer.text
        problem(answer, answer.status_code, answer.json()["code"])


def test_an_unknown_method_is_a_problem_that_names_the_known_ones(small_plant: Plant) -> None:
    answer = small_plant.call("PATCH", "/runs")

    problem(answer, 405, "method-not-allowed")
    assert answer.headers["allow"]


def test_a_large_json_body_is_refused(small_plant: Plant) -> None:
    problem(small_plant.call("POST", "/skus", content=b" " * 1_000_001, headers=JSON), 413, "too-large")


@pytest.mark.parametrize("header", ["", "Bearer", "Bearer ", "Basic eDp5", "Bearer \u00e4", "Bearer a b"])
def test_a_header_without_a_key_is_refused(small_plant: Plant, header: str) -> None:
    answer = small_plant.client.get("/api/v1/runs", headers={b"Authorization": header.encode("utf-8")})

    problem(answer, 401, "not-authenticated")
    assert answer.headers["www-authenticate"] == "Bearer"


SIGNATURES = [b"", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"BM", b"P5\n", b"II*\x00"]
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=8,
)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(path=st.sampled_from(POSTS), field=st.sampled_from(sorted(SKU)), value=VALUES)
def test_no_value_in_a_document_makes_the_service_fail(
    small_plant: Plant, path: str, field: str, value: object
) -> None:
    body = json.dumps({**SKU, "serial": "A", "sku": "tiny", "spec": value, "role": value, field: value})

    answer = small_plant.call("POST", path, content=body.encode("utf-8", "surrogatepass"), headers=JSON)

    assert answer.status_code < 500, answer.text


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.binary(max_size=200), start=st.sampled_from(SIGNATURES))
def test_no_bytes_make_an_upload_fail(small_plant: Plant, content: bytes, start: bytes) -> None:
    run_id = small_plant.get("/runs").json()["items"][0]["id"]

    answer = small_plant.send(run_id, start + content)

    assert 400 <= answer.status_code < 500, answer.text


def test_the_fault_of_a_route_tells_nothing_of_the_inside(small_plant: Plant) -> None:
    services = small_plant.app.state.services
    small_plant.app.state.services = None
    try:
        answer = small_plant.client.get("/readyz")
    finally:
        small_plant.app.state.services = services

    refused = problem(answer, 500, "internal-error")
    assert refused["trace_id"] in refused["detail"]
    assert "NoneType" not in answer.text
    assert "Traceback" not in answer.text
