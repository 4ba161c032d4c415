"""Exports over REST: their types and names, no unmarked FAIL, many runs in parts, and blocks read back."""

import base64
import csv
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from sqlalchemy import select

from service.storage.models import AuditEntryRow
from service.storage.words import Role
from service.usecases.exports.formats import FORMATS
from tests.databases import sqlite_copy
from tests.plant import Plant, picture, pose_set, problem, running_plant
from tests.usecases.test_block import LAYOUT


def fail(plant: Plant, serial: str) -> str:
    """A run whose pictures were taken at other poses than asked."""
    run_id = plant.open_run(serial)
    count = len(pose_set().poses)
    for told in range(count):
        plant.expect(201, plant.upload_as(run_id, shown=count - 1 - told, told=told))
    assert plant.finish(run_id).json()["verdict"] == "FAIL"
    return run_id


@pytest.fixture(scope="module")
def line(migrated_sqlite: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Plant]:
    """A plant with two runs that passed and one that failed; nothing here changes them."""
    directory = tmp_path_factory.mktemp("line")
    with running_plant(sqlite_copy(migrated_sqlite, directory), directory) as plant:
        plant.publish_sku()
        plant.finished_run("VIN-1")
        plant.finished_run("VIN-1")
        fail(plant, "VIN-2")
        plant.open_run("VIN-3")
        yield plant


def run_of(plant: Plant, verdict: str) -> str:
    items = plant.get(f"/runs?verdict={verdict}").json()["items"]
    return str(items[0]["id"])


def test_every_format_is_listed(line: Plant) -> None:
    formats = line.get("/exports").json()["formats"]

    assert [one["name"] for one in formats] == [*FORMATS]
    assert {one["name"] for one in formats if one["is_table"]} == {"csv", "parquet"}


@pytest.mark.parametrize("name", sorted(set(FORMATS) - {"kalibr", "block"}))
def test_a_format_has_its_type_and_a_name_with_the_serial(line: Plant, name: str) -> None:
    answer = line.get(f"/runs/{run_of(line, 'PASS')}/exports/{name}")

    assert answer.status_code == 200, answer.text
    assert answer.headers["content-type"] == FORMATS[name].media_type
    file_name = answer.headers["content-disposition"].split('"')[1]
    assert file_name.startswith("VIN-1-")
    assert file_name.endswith(f"-{name}.{FORMATS[name].suffix}")


@pytest.mark.parametrize("name", sorted(set(FORMATS) - {"kalibr", "block"}))
def test_a_fail_leaves_only_where_it_is_asked_for(line: Plant, name: str) -> None:
    path = f"/runs/{run_of(line, 'FAIL')}/exports/{name}"

    refused = problem(line.get(path), 409, "result-failed")
    given = line.get(f"{path}?allow_failed=true")

    assert "allow_failed" in refused["detail"]
    assert given.status_code == 200
    assert "-FAIL." in given.headers["content-disposition"]


def test_what_cannot_be_exported_is_told(line: Plant) -> None:
    passed = run_of(line, "PASS")
    opened = line.get("/runs?serial=VIN-3").json()["items"][0]["id"]

    problem(line.get(f"/runs/{passed}/exports/kalibr"), 422, "format-cannot-say")
    problem(line.get(f"/runs/{passed}/exports/block"), 422, "block-layout-unusable")
    problem(line.get(f"/runs/{passed}/exports/matlab"), 404, "not-found")
    problem(line.get(f"/runs/{opened}/exports/csv"), 404, "not-found")
    problem(line.get("/exports/pdf"), 404, "not-found")
    problem(line.get("/exports/csv?limit=0"), 422, "validation-failed")
    problem(line.get("/exports/csv?cursor=x"), 400, "cursor-invalid")


def test_many_runs_come_in_parts_and_without_those_that_failed(line: Plant) -> None:
    everything = line.get("/exports/csv?limit=1000")
    first = line.get("/exports/csv?limit=1")
    second = line.get(f"/exports/csv?limit=1&cursor={first.headers['x-next-cursor']}")

    assert everything.headers["x-runs"] == "2"
    assert "x-next-cursor" not in everything.headers
    rows = list(csv.DictReader(io.StringIO(everything.text, newline="")))
    parts = [*csv.DictReader(io.StringIO(first.text)), *csv.DictReader(io.StringIO(second.text))]
    assert rows == parts
    assert {row["verdict"] for row in rows} == {"PASS"}
    assert "x-next-cursor" not in second.headers


def test_many_runs_are_filtered_as_their_list_is(line: Plant) -> None:
    found = line.get("/exports/parquet?allow_failed=true")
    failed = line.get("/exports/parquet?allow_failed=true&verdict=FAIL&serial=VIN-2&counted=true")
    none = line.get("/exports/parquet?sku=other")

    assert found.headers["x-runs"] == "3"
    table = pq.read_table(io.BytesIO(failed.content))
    assert set(table.column("run_id").to_pylist()) == {run_of(line, "FAIL")}
    assert pq.read_table(io.BytesIO(none.content)).num_rows == 0


def test_a_block_is_made_by_a_layout_and_checked_when_it_is_read_back(line: Plant) -> None:
    run_id = run_of(line, "PASS")
    made = line.post(f"/runs/{run_id}/block", {"layout": LAYOUT}, role=Role.VIEWER)
    assert made.status_code == 200, made.text
    right = {"block": base64.b64encode(made.content).decode(), "layout": LAYOUT}
    wrong = {"block": base64.b64encode(b"\xff" * 128).decode(), "layout": LAYOUT}

    same = line.expect(200, line.post(f"/runs/{run_id}/block/check", right, role=Role.MES))
    other = line.expect(200, line.post(f"/runs/{run_id}/block/check", wrong, role=Role.MES))

    assert same == {"matches": True, "crc_holds": True, "differences": []}
    assert not other["matches"]
    assert {one["field"] for one in other["differences"]} >= {"fx", "serial", "crc"}
    with line.app.state.services.database.read() as session:
        query = select(AuditEntryRow).where(AuditEntryRow.action == "block.check").order_by(AuditEntryRow.at)
        assert [entry.facts["matches"] for entry in session.scalars(query)] == [True, False]


def test_a_layout_belongs_to_the_sku(small_plant: Plant) -> None:
    small_plant.publish_sku()
    document = small_plant.get("/skus/tiny").json()["revisions"][0]["document"]
    revised = small_plant.expect(
        201, small_plant.post("/skus/tiny/revisions", document | {"block_layout": LAYOUT})
    )
    assert revised["document"]["block_layout"]["crc"]["first"] == 4
    small_plant.expect(200, small_plant.post("/skus/tiny/revisions/2/publish"))
    run_id = small_plant.open_run(purpose="trial")
    for index in range(4):
        small_plant.expect(201, small_plant.send(run_id, picture(index)))
    small_plant.expect(200, small_plant.finish(run_id))

    block = small_plant.get(f"/runs/{run_id}/exports/block?allow_failed=true")
    body = {"block": base64.b64encode(block.content).decode()}

    assert (len(block.content), block.content[:6]) == (128, b"DMSC\x02\x00")
    checked = small_plant.expect(200, small_plant.post(f"/runs/{run_id}/block/check", body, role=Role.MES))
    assert checked["matches"]


@pytest.mark.parametrize(
    "body",
    [{}, {"block": "%%%"}, {"block": "AA==", "layout": {}}, {"block": 7}, {"block": "AA==", "more": 1},
     {"block": "A" * 200_000}],
)  # fmt: skip
def test_a_read_back_that_makes_no_sense_is_refused(line: Plant, body: dict[str, Any]) -> None:
    run_id = run_of(line, "PASS")

    problem(line.post(f"/runs/{run_id}/block/check", body, role=Role.MES), 422, "validation-failed")


def test_a_layout_that_overlaps_is_refused_by_field(line: Plant) -> None:
    fields = [
        {"name": "a", "type": "u32", "constant": 1},
        {"name": "b", "type": "u8", "at": 1, "constant": 1},
    ]
    body = {"layout": LAYOUT | {"fields": fields}}

    refused = problem(line.post(f"/runs/{run_of(line, 'PASS')}/block", body), 422, "validation-failed")

    assert "a and b overlap" in json.dumps(refused)
