"""A run that is guided with a ChArUco board at a virtual station, parts of the board out of sight."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.guiding import connected, planned_station
from tests.plant import SKU, Plant

CODED = {
    **SKU,
    "target": "charuco:8x5:30mm:22mm:4x4_250",
    "pose_count": 6,
    "pose_space": {"separation_px": 30.0, "distance_m": [0.25, 0.6]},
    "limits": {**SKU["limits"], "coverage": 0.5},
}


@pytest.fixture
def station(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """A virtual station for the coded board."""
    with planned_station(sqlite_address, tmp_path, CODED) as running:
        yield running


@pytest.mark.timeout(240)
def test_a_charuco_board_is_guided_to_a_stored_pass(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-CODED", sku="tiny")
        run = kiosk.until("run")
        verdict = kiosk.until("verdict")
    stored = station.get(f"/runs/{run['run_id']}").json()

    assert (verdict["verdict"], stored["state"], stored["captures"]) == ("PASS", "finished", 6)
    assert run["board"] == {"columns": 8, "rows": 5, "dot_steps": None}
    seen = [told["seen"] for told in kiosk.told if told["type"] == "state" and told["seen"] is not None]
    assert {len(one["corners"]) for one in seen} == {40}
    result = station.get(f"/runs/{run['run_id']}/result").json()
    assert result["intrinsics"]["fx"] == pytest.approx(675.0, rel=0.03)
