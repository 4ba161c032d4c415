"""A virtual board that is moved by mouse and keys in a real browser, along the guidance, to a capture."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, WebSocket, expect

from service.demo.customer import Customer
from tests.browser.chromium import Watch, find_chromium
from tests.browser.kiosk_station import stored_run, taken, wait_for_hint
from tests.browser.reactive import prepare_sku
from tests.browser.serving import Serving, prepare_service

DEG_PER_PX = 0.25
WHEEL_PX = 2000.0  # for a share of 1


@pytest.fixture(scope="module")
def station(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service with a station whose board is moved at the kiosk."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("by-hand"))
    service.start()
    customer = Customer.of(service.url, service.key)
    with customer.http:
        prepare_sku(customer)
        customer.add_virtual_station("virtual", "By mouse", "virtual:mouse")
    yield service
    service.stop()


class Person:
    """Whoever sits before the page: sees the newest state, and has a mouse and keys."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.state: dict[str, Any] = {}
        page.on("websocket", self._watch)

    def look(self) -> dict[str, float] | None:
        """How the board must move, as the newest picture shows it."""
        self.page.wait_for_timeout(60)
        difference: dict[str, float] | None = self.state.get("difference")
        return difference

    def drag(self, x: float, y: float, button: Any = "left", key: str | None = None) -> None:
        """Drag over the picture by css px."""
        box = self.page.locator(".board-hand").bounding_box()
        assert box is not None
        middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        mouse = self.page.mouse
        mouse.move(*middle)
        if key is not None:
            self.page.keyboard.down(key)
        mouse.down(button=button)
        mouse.move(middle[0] + x, middle[1] + y, steps=4)
        mouse.up(button=button)
        if key is not None:
            self.page.keyboard.up(key)

    def wheel(self, closer_share: float) -> None:
        """Turn the wheel over the picture."""
        self.page.locator(".board-hand").hover()
        self.page.mouse.wheel(0, -WHEEL_PX * closer_share)

    def scale(self) -> float:
        """Css px per px of the image."""
        box = self.page.locator(".board-hand").bounding_box()
        assert box is not None
        return min(box["width"] / 640, box["height"] / 400)

    def _watch(self, socket: WebSocket) -> None:
        def receive(payload: str | bytes) -> None:
            if isinstance(payload, bytes):
                self.state = json.loads(payload[4 : 4 + int.from_bytes(payload[:4], "little")])

        socket.on("framereceived", receive)


def bring_there(person: Person) -> None:
    """Move the board by the gestures until the pose is taken."""
    gestures: list[Callable[[dict[str, float]], None]] = [
        lambda left: person.drag(
            -left["turn_deg"] / DEG_PER_PX, left["tilt_deg"] / DEG_PER_PX, button="right"
        ),
        lambda left: person.wheel(left["closer_share"]),
        lambda left: person.drag(left["right_px"] * person.scale(), left["down_px"] * person.scale()),
        lambda left: person.drag(left["roll_deg"] / DEG_PER_PX, 0.0, key="Alt"),
    ]
    for round_ in range(12):
        for gesture in gestures:
            left = person.look()
            if taken(person.page) > 0:
                return
            if left is not None and person.state["match"] < 1:
                gesture(left)
        assert round_ < 11, person.state


def test_a_board_that_is_dragged_to_the_first_pose_is_captured(
    page: Page, station: Serving, watch: Watch, shots: Path
) -> None:
    page.set_viewport_size({"width": 1600, "height": 900})
    person = Person(page)
    page.goto(f"{station.url}/kiosk?station=virtual#key={station.key}")
    page.get_by_label("Serial", exact=True).fill("PRACTICE-1")
    page.keyboard.press("Enter")
    expect(page.locator(".board-hand")).to_be_visible()
    wait_for_hint(page, bool)
    page.screenshot(path=shots / "by-hand-start.png")

    bring_there(person)

    page.screenshot(path=shots / "by-hand-taken.png")
    run = stored_run(station, "PRACTICE-1")
    assert (run["purpose"], run["captures"]) == ("simulated", taken(page))
    before = person.state["seen"]["outline"]
    for _ in range(5):
        page.keyboard.press("e")
    page.wait_for_timeout(300)
    assert person.state["seen"]["outline"] != before
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
