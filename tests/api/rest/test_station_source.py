"""Where a station's frames come from: accepted, changed, and shown without what is secret."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from service.storage.models import AuditEntryRow
from service.storage.words import Role
from tests.plant import Plant, problem, running_plant

CAMERA = "rtsp://joe:s3cret@10.0.0.7/cam?channel=1"
SHOWN = "rtsp://***@10.0.0.7/cam?channel=***"


@pytest.fixture
def plant(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    with running_plant(sqlite_address, tmp_path) as running:
        yield running


def register(plant: Plant, source: str) -> str:
    made = plant.expect(201, plant.post("/stations", {"code": "cal1", "name": "One", "source": source}))
    return str(made["source"])


def test_an_address_is_shown_to_nobody_with_what_is_secret_in_it(plant: Plant) -> None:
    assert register(plant, CAMERA) == SHOWN

    stations = plant.get("/stations").text
    standings = plant.get("/statistics/stations")
    with plant.app.state.services.database.read() as session:
        trail = str([row.facts for row in session.query(AuditEntryRow)])
    assert standings.json()["items"][0]["source"] == SHOWN
    assert "s3cret" not in stations + standings.text + trail
    assert SHOWN in trail


def test_a_source_is_changed_by_an_engineer_and_that_is_on_record(plant: Plant) -> None:
    register(plant, "browser")
    body = {"source": "v4l2:/dev/video0"}

    refused = plant.call("PATCH", "/stations/cal1", Role.OPERATOR, json=body)
    changed = plant.expect(200, plant.call("PATCH", "/stations/cal1", Role.ENGINEER, json=body))

    problem(refused, 403, "role-missing")
    assert (changed["code"], changed["source"]) == ("cal1", "v4l2:/dev/video0")
    assert plant.get("/stations").json()["items"][0]["source"] == "v4l2:/dev/video0"
    with plant.app.state.services.database.read() as session:
        entry = session.query(AuditEntryRow).filter_by(action="station.source").one()
    assert (entry.who, entry.facts) == ("engineer", {"source": "v4l2:/dev/video0"})


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("ftp://camera/stream", "rtsp://"),
        ("http://", "no host"),
        ("v4l2:/dev/sda", "/dev/videoN"),
        ("file:replays", "DMSCAL_FRAMES_DIR"),
        (SHOWN, "whole address"),
    ],
)
def test_a_source_that_cannot_be_is_refused_with_what_to_do(plant: Plant, source: str, words: str) -> None:
    register(plant, "browser")

    made = plant.post("/stations", {"code": "cal2", "name": "Two", "source": source})
    changed = plant.call("PATCH", "/stations/cal1", json={"source": source})

    assert words in problem(made, 422, "source-refused")["detail"]
    assert words in problem(changed, 422, "source-refused")["detail"]
    assert [one["source"] for one in plant.get("/stations").json()["items"]] == ["browser"]


def test_a_station_that_is_not_there_gets_no_source(plant: Plant) -> None:
    problem(plant.call("PATCH", "/stations/none", json={"source": "browser"}), 404, "not-found")


def test_files_are_accepted_where_a_directory_is_named(sqlite_address: str, tmp_path: Path) -> None:
    with running_plant(sqlite_address, tmp_path, frames_dir=str(tmp_path)) as plant:
        assert register(plant, "file:replays") == "file:replays"
        problem(plant.call("PATCH", "/stations/cal1", json={"source": "file:../x"}), 422, "source-refused")
