"""Who is let in at the guidance socket, and how it ends on what it cannot read."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from service.api.ws import guidance
from service.storage.words import Role
from tests.guiding import ADDRESS, add_station, connected, film
from tests.plant import Plant, running_plant


@pytest.fixture
def station(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """A plant with a virtual station."""
    with running_plant(sqlite_address, tmp_path, make_source=film, max_image_megapixels=1) as running:
        add_station(running)
        yield running


def sent_away(plant: Plant, *messages: str | bytes, code: str = "cal1") -> tuple[str, int]:
    """The problem's code and the close code that these messages end with."""
    with plant.client.websocket_connect(ADDRESS.format(code=code)) as socket:
        for message in messages:
            socket.send_bytes(message) if isinstance(message, bytes) else socket.send_text(message)
        heard: list[Any] = []
        while not heard or heard[-1]["type"] != "websocket.close":
            heard.append(socket.receive())
    problem = json.loads(heard[-2]["text"])
    assert problem["type"] == "problem"
    assert len(problem["detail"]) > 10
    return problem["code"], heard[-1]["code"]


def hello(key: str, role: str = "kiosk", protocol: int = 1) -> str:
    return json.dumps({"type": "hello", "key": key, "protocol": protocol, "role": role})


def test_an_unknown_key_is_sent_away(station: Plant) -> None:
    assert sent_away(station, hello("dmscal_no_such_key")) == ("not-authenticated", 4401)


def test_whoever_does_not_say_hello_first_is_sent_away(station: Plant) -> None:
    assert sent_away(station, '{"type": "capture"}') == ("not-authenticated", 4401)


def test_silence_is_not_waited_for(station: Plant, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guidance, "HELLO_S", 0.1)

    assert sent_away(station) == ("not-authenticated", 4401)


@pytest.mark.parametrize("role", [Role.VIEWER, Role.MES])
def test_a_kiosk_needs_an_operators_key(station: Plant, role: Role) -> None:
    assert sent_away(station, hello(station.keys[role])) == ("role-missing", 4403)


@pytest.mark.parametrize("role", list(Role))
def test_every_role_may_watch(station: Plant, role: Role) -> None:
    with connected(station, kind="monitor", role=role) as monitor:
        assert monitor.told[0]["source"] == "virtual"


def test_the_welcome_names_the_stations_language(station: Plant) -> None:
    with connected(station) as kiosk:
        assert kiosk.told[0]["language"] is None
    station.expect(200, station.call("PATCH", "/stations/cal1", json={"language": "de"}))

    with connected(station) as kiosk:
        assert kiosk.told[0]["language"] == "de"


def test_a_revoked_key_is_sent_away(station: Plant) -> None:
    made = station.expect(201, station.post("/keys", {"name": "old", "role": "operator"}))
    station.expect(200, station.post(f"/keys/{made['id']}/revoke"))

    assert sent_away(station, hello(made["key"])) == ("not-authenticated", 4401)


def test_an_unknown_station_is_told(station: Plant) -> None:
    assert sent_away(station, hello(station.keys[Role.OPERATOR]), code="none") == ("not-found", 4404)


def test_another_version_of_the_protocol_is_told(station: Plant) -> None:
    assert sent_away(station, hello(station.keys[Role.OPERATOR], protocol=2)) == ("bad-request", 4400)


@pytest.mark.parametrize(
    "garbage", ["", "no json", "[]", "7", '{"type": "surprise"}', "{}", "\ud7ff\u0000", "[" * 5000]
)
def test_garbage_ends_the_socket(station: Plant, garbage: str) -> None:
    greeting = hello(station.keys[Role.OPERATOR])

    assert sent_away(station, greeting, garbage) == ("bad-request", 4400)


def test_a_picture_where_the_service_has_the_camera_ends_the_socket(station: Plant) -> None:
    assert sent_away(station, hello(station.keys[Role.OPERATOR]), b"\0" * 40) == ("bad-request", 4400)


@pytest.mark.parametrize("message", ["x" * 100_000, b"x" * 1_200_000])
def test_what_is_too_large_ends_the_socket(station: Plant, message: str | bytes) -> None:
    assert sent_away(station, hello(station.keys[Role.OPERATOR]), message) == ("too-large", 4413)


def test_nothing_large_is_read_before_the_hello(station: Plant) -> None:
    assert sent_away(station, b"x" * 5000) == ("too-large", 4413)
