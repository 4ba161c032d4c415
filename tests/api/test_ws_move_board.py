"""A virtual station whose board is moved by whoever is at the kiosk."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tests.guiding import Client, JsonObject, add_station, connected
from tests.plant import Plant, running_plant

MOVES = ("right_px", "down_px", "closer_share", "tilt_deg", "turn_deg", "roll_deg")
SEEN = 0.2
GAIN = 0.7  # of what is left: whoever follows the guidance does not do it all at once


@pytest.fixture(scope="module")
def station(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Plant]:
    """A plant with a station to practise at, and one with a simulated hand."""
    directory: Path = tmp_path_factory.mktemp("held")
    with running_plant(f"sqlite:///{directory / 'held.db'}", directory) as running:
        running.publish_sku()
        add_station(running, "held", "virtual:mouse")
        add_station(running, "hand", "virtual")
        yield running


def follow(kiosk: Client) -> JsonObject:
    """Move the board as the differences say until a capture is accepted, each time seeing what that did.

    Whoever moves again before the picture shows the move goes too far, the more the slower the machine is.
    """
    before = np.full(len(MOVES), np.inf)
    while True:
        heard = kiosk.hear()
        if heard["type"] == "capture_accepted":
            return heard
        assert heard["type"] in {"state", "run"}, heard
        difference = heard.get("difference")
        if difference is None or heard["match"] >= 1 or heard["is_capturing"]:
            continue
        left = np.array([difference[name] for name in MOVES])
        # All of a move is seen at once, so that whatever is most of it tells.
        if not np.linalg.norm(left - before) < SEEN * np.linalg.norm(before):
            kiosk.say("move_board", **{name: GAIN * float(left[i]) for i, name in enumerate(MOVES)})
            before = left


def test_moves_along_the_guidance_lead_to_an_exact_capture(station: Plant) -> None:
    with connected(station, "held") as kiosk:
        assert kiosk.told[-1]["moves_board"]
        kiosk.say("open_run", serial="PRACTICE-1", sku="tiny")
        run = kiosk.until("run")
        taken = follow(kiosk)
    stored = station.get(f"/runs/{run['run_id']}").json()

    assert (run["purpose"], taken["pose_index"], stored["captures"]) == ("simulated", 0, 1)
    assert taken["match_error_px"] < 0.02 * 640


def test_moves_between_two_frames_add_up_and_the_board_stays_in_the_picture(station: Plant) -> None:
    with connected(station, "held") as kiosk:
        kiosk.say("open_run", serial="PRACTICE-2", sku="tiny")
        before = kiosk.until(lambda m: m["type"] == "state" and m["board"] == "present")
        for _ in range(4):
            kiosk.say("move_board", right_px=10.0)
        wanted = before["seen"]["outline"][0][0] + 40.0
        kiosk.until(lambda m: m["type"] == "state" and abs(m["seen"]["outline"][0][0] - wanted) < 3.0)
        kiosk.say("move_board", right_px=5000.0, closer_share=-0.1)
        after = [kiosk.until("state") for _ in range(6)][-1]
        kiosk.say("abort")
        kiosk.until("run_closed")

    assert abs(after["seen"]["outline"][0][0] - wanted) < 3.0


@pytest.mark.parametrize(
    ("code", "fields", "problem"),
    [
        ("hand", {"right_px": 1.0}, "state-forbids"),
        ("held", {"right_px": 1e6}, "validation-failed"),
        ("held", {"closer_share": -1.0}, "validation-failed"),
        ("held", {"spin": 1.0}, "validation-failed"),
    ],
)
def test_moves_that_cannot_be_are_told(
    station: Plant, code: str, fields: dict[str, float], problem: str
) -> None:
    with connected(station, code) as kiosk:
        kiosk.say("move_board", **fields)
        assert kiosk.until("problem")["code"] == problem


def test_a_monitor_moves_nothing(station: Plant) -> None:
    with connected(station, "held", "monitor") as monitor:
        assert not monitor.told[-1]["moves_board"]
        monitor.say("move_board", right_px=1.0)
        assert monitor.until("problem")["code"] == "role-missing"
