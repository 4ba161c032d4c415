"""In which language a station's kiosk starts: given, changed, taken away, and on record."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from service.storage.models import AuditEntryRow
from service.storage.words import Role
from tests.plant import Plant, problem, running_plant


@pytest.fixture
def plant(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    with running_plant(sqlite_address, tmp_path) as running:
        yield running


def register(plant: Plant, **more: str) -> str | None:
    made = plant.expect(201, plant.post("/stations", {"code": "cal1", "name": "One", **more}))
    return None if made["language"] is None else str(made["language"])


def test_a_station_leaves_the_language_to_the_browser_unless_it_has_one(plant: Plant) -> None:
    assert register(plant) is None

    changed = plant.expect(200, plant.call("PATCH", "/stations/cal1", json={"language": "zh"}))

    assert (changed["language"], changed["source"]) == ("zh", "browser")
    assert plant.get("/statistics/stations").json()["items"][0]["language"] == "zh"


def test_a_change_of_the_source_keeps_the_language_and_null_takes_it_away(plant: Plant) -> None:
    assert register(plant, language="de") == "de"

    kept = plant.expect(200, plant.call("PATCH", "/stations/cal1", json={"source": "virtual"}))
    taken = plant.expect(200, plant.call("PATCH", "/stations/cal1", json={"language": None}))

    assert (kept["source"], kept["language"]) == ("virtual", "de")
    assert (taken["source"], taken["language"]) == ("virtual", None)


def test_the_language_is_an_engineers_to_change_and_that_is_on_record(plant: Plant) -> None:
    register(plant)

    refused = plant.call("PATCH", "/stations/cal1", Role.OPERATOR, json={"language": "de"})
    plant.expect(200, plant.call("PATCH", "/stations/cal1", Role.ENGINEER, json={"language": "de"}))

    problem(refused, 403, "role-missing")
    with plant.app.state.services.database.read() as session:
        entry = session.query(AuditEntryRow).filter_by(action="station.language").one()
    assert (entry.who, entry.facts) == ("engineer", {"language": "de"})


@pytest.mark.parametrize("body", [{"language": "fr"}, {"language": "zh-CN"}, {}, {"source": None}])
def test_a_language_without_words_and_a_change_of_nothing_are_refused(
    plant: Plant, body: dict[str, str | None]
) -> None:
    register(plant)

    problem(plant.call("PATCH", "/stations/cal1", json=body), 422, "validation-failed")
