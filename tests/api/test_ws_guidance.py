"""The guidance socket at a virtual station: a run, its interruptions, and those who watch."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from service.api.ws import desk
from service.core.errors import ServiceError
from service.storage.words import Role
from tests.guiding import ADDRESS, Client, add_station, connected, film
from tests.plant import SKU, Plant, poses_json, running_plant

POSES = len(poses_json())


@pytest.fixture
def station(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """A plant with a virtual station that shows the pictures of the poses as fast as they are judged."""
    with running_plant(sqlite_address, tmp_path, make_source=film, virtual_speed=1000) as running:
        running.publish_sku()
        add_station(running)
        yield running


def refused(plant: Plant, client: Client) -> str:
    """The code of the next problem."""
    return str(client.until("problem")["code"])


def test_a_run_is_guided_from_its_serial_to_a_stored_pass(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        run = kiosk.until("run")
        verdict = kiosk.until("verdict")
        stored = station.get(f"/runs/{run['run_id']}").json()

    assert (verdict["verdict"], stored["verdict"], stored["state"]) == ("PASS", "PASS", "finished")
    assert (stored["purpose"], stored["station"], stored["captures"]) == ("simulated", "cal1", POSES)
    assert {gate["gate"] for gate in verdict["gates"]} >= {"poses", "fit", "certainty"}
    assert station.get(verdict["result"].removeprefix("/api/v1")).json()["verdict"] == "PASS"


def test_the_run_message_shows_every_pose_and_the_accuracy_grows(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        run = kiosk.until("run")
        few, all_of_them = kiosk.captures(4), kiosk.captures(POSES)

    assert [len(pose["outline"]) for pose in run["poses"]] == [4] * POSES
    assert run["board"] == {"columns": 7, "rows": 5, "dot_steps": None}
    assert (run["captured"], run["pose_index"], run["accuracy"]) == ([], 0, None)
    assert all_of_them["accuracy"]["fx_px"] < few["accuracy"]["fx_px"]


def test_a_state_comes_with_its_picture_and_what_to_do(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        state = kiosk.until(lambda m: m["type"] == "state" and bool(m["hints"]))
        assert kiosk.jpeg[:2] == b"\xff\xd8"

    assert state["board"] == "present"
    assert len(state["seen"]["corners"]) == len(state["ghost"]["corners"]) == 35
    assert len(state["hints"]) <= 2
    assert 0 <= state["match"] <= 1


def test_a_reloaded_kiosk_goes_on_with_every_capture(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        run = kiosk.until("run")
        kiosk.captures(3)
    stored = station.get(f"/runs/{run['run_id']}").json()["capture_list"]

    with connected(station) as kiosk:
        again = kiosk.until("run")
        kiosk.until("verdict")

    assert again["run_id"] == run["run_id"]
    assert again["captured"] == sorted(capture["pose_index"] for capture in stored)
    assert len(stored) >= 3


def test_opening_the_same_serial_again_shows_the_same_run(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("set_automatic", automatic=False)
        assert refused(station, kiosk) == "state-forbids"
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        first = kiosk.until("run")
        kiosk.say("open_run", serial=" VIN-1 ", sku="tiny")
        second = kiosk.until("run")
        kiosk.say("open_run", serial="VIN-2", sku="tiny")
        assert refused(station, kiosk) == "state-forbids"

    assert first["run_id"] == second["run_id"]
    assert len(station.get("/runs").json()["items"]) == 1


def test_an_order_without_a_station_becomes_this_stations(station: Plant) -> None:
    ordered = station.open_run("VIN-9")

    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-9")
        run = kiosk.until("run")

    assert run["run_id"] == ordered
    assert station.get(f"/runs/{ordered}").json()["station"] == "cal1"


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"serial": "VIN*", "sku": "tiny"}, "serial-invalid"),
        ({"serial": "VIN-1", "sku": "none"}, "not-found"),
        ({"serial": "VIN-1"}, "not-found"),
        ({"serial": "VIN-1", "sku": "NOT A CODE"}, "validation-failed"),
        ({"serial": "x" * 300, "sku": "tiny"}, "validation-failed"),
        ({"serial": "VIN-1", "sku": "tiny", "surprise": 1}, "validation-failed"),
    ],
)
def test_a_run_that_cannot_be_opened_is_told_and_the_socket_goes_on(
    station: Plant, fields: dict[str, object], code: str
) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", **fields)
        assert refused(station, kiosk) == code
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kiosk.until("run")


def test_captures_by_hand_are_undone_and_taken_again(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kiosk.captures(2)
        kiosk.say("set_automatic", automatic=False)
        held = kiosk.until("run")
        kiosk.say("undo")
        undone = kiosk.until("run")
        kiosk.say("retake", pose_index=undone["captured"][0])
        retaken = kiosk.until("run")
        kiosk.until(lambda m: m["type"] == "state" and m["match"] == 1.0)
        kiosk.say("capture")
        taken = kiosk.until(lambda m: m["type"] in {"capture_accepted", "capture_refused"})

    assert len(undone["captured"]) == len(held["captured"]) - 1
    assert len(retaken["captured"]) == len(held["captured"]) - 2
    assert taken["type"] == "capture_accepted"
    assert not held["automatic"]


def test_a_capture_of_another_pose_is_refused_by_hand(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kiosk.until("run")
        kiosk.say("set_automatic", automatic=False)
        kiosk.until("run")
        kiosk.say("retake", pose_index=POSES - 1)
        kiosk.say("capture")
        answer = kiosk.until(lambda m: m["type"].startswith("capture_"))

    assert answer["type"] == "capture_accepted" or answer["code"] == "pose-not-matched"


def test_an_aborted_run_is_closed_and_the_next_can_be_opened(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        run = kiosk.until("run")
        kiosk.say("abort")
        closed = kiosk.until("run_closed")
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        other = kiosk.until("run")

    assert closed == {"type": "run_closed", "run_id": run["run_id"], "reason": "aborted"}
    assert other["run_id"] != run["run_id"]
    assert station.get(f"/runs/{run['run_id']}").json()["state"] == "aborted"


def test_a_run_that_is_aborted_elsewhere_is_told_and_closed(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        run = kiosk.until("run")
        station.expect(200, station.post(f"/runs/{run['run_id']}/abort", role=Role.OPERATOR))
        assert refused(station, kiosk) == "run-aborted"
        assert kiosk.until("run_closed")["reason"] == "aborted"


def test_the_verdict_is_shown_again_after_a_reload_until_the_next_vehicle(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        verdict = kiosk.until("verdict")
    with connected(station) as kiosk:
        again = kiosk.until("verdict")
        kiosk.say("next_vehicle")
        closed = kiosk.until("run_closed")
        kiosk.say("open_run", serial="VIN-2", sku="tiny")
        assert kiosk.until("run")["serial"] == "VIN-2"

    assert again == verdict
    assert closed["reason"] == "next_vehicle"


def test_an_open_run_is_not_left_for_the_next_vehicle(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kiosk.until("run")
        kiosk.say("next_vehicle")
        assert refused(station, kiosk) == "state-forbids"


def test_a_resumed_run_of_a_retired_revision_says_so_and_goes_on(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kiosk.captures(1)
    station.expect(201, station.post("/skus/tiny/revisions", SKU))
    station.expect(200, station.post("/skus/tiny/revisions/2/publish"))

    with connected(station) as kiosk:
        assert refused(station, kiosk) == "revision-retired"
        assert kiosk.until("verdict")["verdict"] == "PASS"


def test_a_second_kiosk_is_told_and_sent_away(station: Plant, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(desk, "HANDOVER_S", 0.1)
    with connected(station) as first:
        first.say("open_run", serial="VIN-1", sku="tiny")
        with station.client.websocket_connect(ADDRESS.format(code="cal1")) as socket:
            second = Client(socket)
            second.say("hello", key=station.keys[Role.OPERATOR], protocol=1, role="kiosk")
            assert second.hear()["code"] == "station-held"
            assert socket.receive() == {"type": "websocket.close", "code": 4409, "reason": "station-held"}
        assert first.until("verdict")["verdict"] == "PASS"


def test_a_monitor_sees_everything_and_may_do_nothing(station: Plant) -> None:
    with connected(station, kind="monitor", role=Role.VIEWER) as monitor, connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        run = monitor.until("run")
        monitor.until("state")
        assert monitor.jpeg[:2] == b"\xff\xd8"
        monitor.say("abort")
        assert refused(station, monitor) == "role-missing"
        assert monitor.until("verdict") == kiosk.until("verdict")

    assert station.get(f"/runs/{run['run_id']}").json()["verdict"] == "PASS"


def test_a_monitor_is_told_that_the_kiosk_left(station: Plant) -> None:
    with connected(station, kind="monitor", role=Role.VIEWER) as monitor:
        with connected(station) as kiosk:
            kiosk.say("open_run", serial="VIN-1", sku="tiny")
            kiosk.until("run")
        assert refused(station, monitor) == "kiosk-left"


def test_without_acknowledgements_two_pictures_come_and_every_message(station: Plant) -> None:
    with connected(station) as kiosk:
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kinds = []
        while "verdict" not in kinds:
            message = kiosk.socket.receive()
            kinds.append("picture" if message.get("bytes") else kiosk_type(message["text"]))

    assert kinds.count("picture") == 2
    assert kinds.count("capture_accepted") == POSES


def kiosk_type(text: str) -> str:
    """The type of a text message."""
    return text.split('"')[3]


def test_every_problem_of_the_socket_has_its_page(station: Plant) -> None:
    for kind in ServiceError.__subclasses__():
        assert station.client.get(f"/problems/{kind.code}").status_code == 200


@pytest.mark.parametrize(("role", "may"), [(Role.OPERATOR, False), (Role.ENGINEER, True)])
def test_only_an_engineer_overrides_the_checks_of_a_capture(station: Plant, role: Role, may: bool) -> None:
    with connected(station, role=role) as kiosk:
        assert kiosk.told[-1]["may_override"] is may
        kiosk.say("open_run", serial="VIN-1", sku="tiny")
        kiosk.until("run")
        kiosk.say("set_automatic", automatic=False)
        kiosk.say("retake", pose_index=0)
        kiosk.until(lambda m: m["type"] == "state" and not m["automatic"] and m["board"] == "present")
        kiosk.say("capture", override=True)
        answer = kiosk.until(lambda m: m["type"] in {"capture_accepted", "problem"})

    assert answer["type"] == ("capture_accepted" if may else "problem")
    assert may or answer["code"] == "role-missing"
