"""Runs that are guided with grids of circles at a virtual station, also one that looks the same turned."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

import numpy as np
import pytest

from service.core.vision.target import parse_target
from tests.guiding import JsonObject, connected, planned_station
from tests.plant import SKU, Plant

DOTS = "circles:4x7:30mm:15mm"
ALIKE = "circles:4x6:30mm:15mm"

Open = Callable[[str, JsonObject], AbstractContextManager[Plant]]


def sku_of(target: str, **space: object) -> JsonObject:
    return {
        **SKU,
        "target": target,
        "pose_count": 6,
        "pose_space": {"separation_px": 30.0, "distance_m": [0.25, 0.6], **space},
        "limits": {**SKU["limits"], "coverage": 0.5},
    }


@pytest.fixture
def opened(sqlite_address: str, tmp_path: Path) -> Open:
    """Opens a virtual station for a grid of circles."""
    return lambda target, space: planned_station(sqlite_address, tmp_path, sku_of(target, **space))


def run_to_verdict(station: Plant) -> tuple[JsonObject, JsonObject, list[JsonObject]]:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-DOTS", sku="tiny")
        run = kiosk.until("run")
        verdict = kiosk.until("verdict")
    return run, verdict, kiosk.told


@pytest.mark.timeout(300)
def test_a_grid_of_circles_is_guided_to_a_stored_pass(opened: Open) -> None:
    with opened(DOTS, {}) as station:
        run, verdict, told = run_to_verdict(station)
        stored = station.get(f"/runs/{run['run_id']}").json()
        result = station.get(f"/runs/{run['run_id']}/result").json()

    assert (verdict["verdict"], stored["state"], stored["captures"]) == ("PASS", "finished", 6)
    assert run["board"] == {"columns": 4, "rows": 7, "dot_steps": 0.5}
    assert {
        len(state["seen"]["corners"]) for state in told if state["type"] == "state" and state["seen"]
    } == {28}
    assert result["intrinsics"]["fx"] == pytest.approx(675.0, rel=0.03)


@pytest.mark.timeout(300)
def test_a_grid_that_looks_the_same_turned_is_guided_to_poses_that_lie_the_other_way(opened: Open) -> None:
    assert parse_target(ALIKE).is_symmetric
    with opened(ALIKE, {"roll_deg": [130.0, 180.0]}) as station:
        run, verdict, told = run_to_verdict(station)

    assert verdict["verdict"] == "PASS"
    rolls = [pose["angles"]["roll_deg"] for pose in run["poses"]]
    assert np.all(np.abs(rolls) > 90.0)
    differences = [one["difference"] for one in told if one["type"] == "state" and one["difference"]]
    assert not any(one["is_upside_down"] for one in differences)
    accepted = [one for one in told if one["type"] == "capture_accepted"]
    assert [one["pose_index"] for one in accepted] == list(range(6))
    assert max(one["match_error_px"] for one in accepted) < 0.02 * 640
