"""A run that is guided with a ChArUco board at a virtual station, parts of the board out of sight."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from service.usecases.planning import PlanRequest, plan_for
from service.usecases.sku_document import SkuDocument
from tests.guiding import add_station, connected
from tests.plant import SKU, Plant, running_plant

CODED = {
    **SKU,
    "target": "charuco:8x5:30mm:22mm:4x4_250",
    "pose_count": 6,
    "pose_space": {"separation_px": 30.0, "distance_m": [0.25, 0.6]},
    "limits": {**SKU["limits"], "coverage": 0.5},
}


@pytest.fixture
def station(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """A plant whose virtual station has a virtual camera, and a hand that reads only hints."""
    with running_plant(sqlite_address, tmp_path, virtual_speed=1000) as running:
        running.expect(201, running.post("/skus", CODED))
        running.expect(200, running.post("/skus/tiny/revisions/1/publish"))
        sku = SkuDocument.model_validate(CODED).to_revision()
        planned = plan_for(sku, PlanRequest(seed=1, candidates=300))
        poses = [{"rvec": list(pose.rvec), "tvec": list(pose.tvec)} for pose in planned.poses]
        made = running.expect(201, running.post("/skus/tiny/revisions/1/pose-sets", {"poses": poses}))
        running.expect(200, running.post(f"/pose-sets/{made['pose_set']['id']}/publish"))
        add_station(running)
        yield running


@pytest.mark.timeout(240)
def test_a_charuco_board_is_guided_to_a_stored_pass(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-CODED", sku="tiny")
        run = kiosk.until("run")
        verdict = kiosk.until("verdict")
    stored = station.get(f"/runs/{run['run_id']}").json()

    assert (verdict["verdict"], stored["state"], stored["captures"]) == ("PASS", "finished", 6)
    assert run["board"] == {"columns": 8, "rows": 5}
    seen = [told["seen"] for told in kiosk.told if told["type"] == "state" and told["seen"] is not None]
    assert {len(one["corners"]) for one in seen} == {40}
    result = station.get(f"/runs/{run['run_id']}/result").json()
    assert result["intrinsics"]["fx"] == pytest.approx(675.0, rel=0.03)
