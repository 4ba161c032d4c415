"""A pose beyond the set over the socket, at a virtual station whose hand reads nothing but the hints."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.guiding import add_station, connected
from tests.plant import Plant, poses_json, running_plant

POSES = 4


@pytest.fixture
def demanding(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """A plant with a virtual station whose SKU asks for more accuracy than its poses give."""
    with running_plant(sqlite_address, tmp_path, virtual_speed=1000) as running:
        running.publish_sku(
            poses=poses_json()[:POSES],
            required_mapping_px=1e-4,
            extra_poses=1,
            limits={"focal_sd_share": 0.5, "centre_sd_px": 50.0, "zone_mapping_px": 20.0, "coverage": 0.1},
        )
        add_station(running)
        yield running


@pytest.mark.timeout(300)
def test_an_extra_pose_is_asked_for_again_after_a_reload_and_then_the_run_ends(demanding: Plant) -> None:
    with connected(demanding) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        first = kiosk.until("run")
        last = kiosk.captures(POSES)
        extra = kiosk.until("run")
    with connected(demanding) as kiosk:
        again = kiosk.until("run")
        taken = kiosk.captures(POSES + 1)
        kiosk.until("verdict")

    assert (first["estimate"], first["total"], last["total"]) == (None, POSES, POSES)
    assert last["estimate"]["captures"] == POSES
    assert last["estimate"]["required_mapping_px"] == 1e-4
    assert 0 < last["estimate"]["reached"] < 1
    assert extra["pose_index"] == POSES
    assert extra["poses"][-1]["added_for"] == "accuracy"
    assert again["poses"] == extra["poses"]
    assert taken["total"] == POSES + 1
    stored = demanding.get(f"/runs/{first['run_id']}").json()
    assert [one["reason"] for one in stored["added_poses"]] == ["accuracy"]
    assert (stored["state"], stored["captures"]) == ("finished", POSES + 1)
