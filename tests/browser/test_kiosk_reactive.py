"""Whole runs through the kiosk's page by an operator in the page who sees only what the kiosk says."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from service.demo.customer import Customer
from tests.browser.chromium import Watch, find_chromium
from tests.browser.kiosk_station import (
    A_RUN_MS,
    stored_run,
    taken,
    verdict_of,
    wait_for_captures,
    wait_for_hint,
)
from tests.browser.reactive import FEW, POSES, TRUTH, prepare_reactive, prepare_sku, reactive_page
from tests.browser.serving import Serving, prepare_service

SIDEWAYS = {"move-left": "move-right", "move-right": "move-left"}
TILTED = {"tilt-top-back": "tilt-top-forward", "tilt-top-forward": "tilt-top-back"}
# Whoever is told the wrong way is given so much longer than whoever is told the right one.
LONGER = 1.3


@pytest.fixture(scope="module")
def stations(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service with stations whose kiosks bring their cameras."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("stations"))
    service.start()
    prepare_reactive(service, "right", "sideways", "tilted", "upside", "turned", "board", "cable", "retired")
    yield service
    service.stop()


@pytest.fixture(autouse=True)
def _nobody_stays(chromium: Browser) -> Iterator[None]:
    """Close what a test that failed has left open: its operators would go on and slow the next one down."""
    yield
    for context in chromium.contexts:
        context.close()


def begin(page: Page, serving: Serving, station: str, serial: str) -> Page:
    """Scan a vehicle at a station and wait until its run is on the screen."""
    page.goto(f"{serving.url}/kiosk?station={station}#key={serving.key}")
    page.get_by_label("Serial", exact=True).fill(serial)
    page.keyboard.press("Enter")
    expect(page.locator(".whose-serial")).to_have_text(serial)
    return page


def end(page: Page) -> None:
    """Abort what is open and close the page; its operator rests, or the run would be over before."""
    page.evaluate("window.reactive.paused = true")
    page.get_by_role("button", name="Abort").click()
    page.get_by_role("button", name="Abort the run").click()
    expect(page.get_by_label("Serial", exact=True)).to_be_visible()
    page.context.close()


def test_what_the_kiosk_says_leads_to_a_pass_and_one_instruction_turned_round_does_not(
    chromium: Browser, stations: Serving, watch: Watch, shots: Path
) -> None:
    page = reactive_page(chromium)
    watch.follow(page)
    begin(page, stations, "right", "VIN-RIGHT")
    expect(verdict_of(page)).to_contain_text("PASS")
    page.screenshot(path=shots / "kiosk-reactive-pass.png")
    assert watch.errors == []
    lived_s = page.evaluate("window.reactive.lived_s")
    page.evaluate("window.reactive.paused = true")

    sideways = begin(reactive_page(chromium, swapped=SIDEWAYS), stations, "sideways", "VIN-SIDEWAYS")
    tilted = begin(reactive_page(chromium, swapped=TILTED), stations, "tilted", "VIN-TILTED")
    for misled in (sideways, tilted):
        misled.wait_for_function("s => window.reactive.lived_s >= s", arg=LONGER * lived_s, timeout=A_RUN_MS)
        assert misled.locator("[data-verdict]").count() == 0
        assert taken(misled) < len(POSES)
        end(misled)
    customer = Customer.of(stations.url, stations.key)
    with customer.http:
        run = stored_run(stations, "VIN-RIGHT")
        result = customer.ask("GET", f"/runs/{run['id']}")["result"]
    assert (run["verdict"], run["captures"], run["purpose"]) == ("PASS", len(POSES), "production")
    for name in ("fx", "fy", "cx", "cy"):
        assert abs(result["intrinsics"][name] - TRUTH[name]) < 4.0 * result["sd"][name] + 0.1

    # Nobody says that it is a retest: it has a result already.
    page.get_by_role("button", name="Next vehicle").click()
    page.get_by_label("Serial", exact=True).fill("VIN-RIGHT")
    page.keyboard.press("Enter")
    expect(page.locator(".purpose")).to_have_text("Retest")
    assert stored_run(stations, "VIN-RIGHT")["purpose"] == "retest"
    page.get_by_role("button", name="Deutsch").click()
    expect(page.locator(".purpose")).to_have_text("Wiederholung")
    page.screenshot(path=shots / "kiosk-retest.png")
    page.context.close()


def test_a_board_upside_down_in_the_very_place_is_told_and_never_taken(
    chromium: Browser, stations: Serving, shots: Path
) -> None:
    place = {"centre": POSES[0][0], "upside_down": True}
    page = begin(reactive_page(chromium, start=place, stubborn=True), stations, "upside", "VIN-UPSIDE")

    wait_for_hint(page, lambda code: code == "turn-upside-down")
    expect(page.locator(".strip-main")).to_have_text("Turn the board round")
    page.wait_for_timeout(1500)
    page.screenshot(path=shots / "kiosk-upside-down.png")
    assert taken(page) == 0
    page.keyboard.press("Space")
    expect(page.locator("[data-problem]")).to_contain_text("The board is not in its place")
    assert stored_run(stations, "VIN-UPSIDE")["captures"] == 0
    end(page)


def test_whoever_turns_it_round_as_told_goes_on(chromium: Browser, stations: Serving) -> None:
    page = begin(reactive_page(chromium, upside_down=True), stations, "turned", "VIN-TURNED")

    wait_for_hint(page, lambda code: code == "turn-upside-down")
    wait_for_captures(page, 1)
    end(page)


def test_another_board_is_told_and_never_taken(chromium: Browser, stations: Serving, shots: Path) -> None:
    other = reactive_page(chromium, board="chessboard:9x6:22mm", stubborn=True)
    page = begin(other, stations, "board", "VIN-BOARD")

    wait_for_hint(page, lambda code: code == "wrong-board")
    expect(page.locator(".strip")).to_contain_text("Take the board that belongs to this station")
    page.screenshot(path=shots / "kiosk-wrong-board.png")
    assert stored_run(stations, "VIN-BOARD")["captures"] == 0
    end(page)


def test_a_run_whose_camera_type_was_revised_meanwhile_says_so_and_goes_on(
    chromium: Browser, stations: Serving, shots: Path
) -> None:
    customer = Customer.of(stations.url, stations.key)
    with customer.http:
        prepare_sku(customer, "aged")
        order = {"sku": "aged", "serial": "VIN-AGED", "station": "retired"}
        run = customer.ask("POST", "/runs", json=order)
        customer.ask("POST", "/skus/aged/revisions", json={**FEW, "code": "aged"})
        customer.ask("POST", "/skus/aged/revisions/2/publish")
    page = reactive_page(chromium)
    page.goto(f"{stations.url}/kiosk?station=retired#key={stations.key}")

    expect(page.locator("[data-problem=revision-retired]")).to_contain_text("was revised meanwhile")
    page.screenshot(path=shots / "kiosk-retired.png")
    page.get_by_role("button", name="Understood").click()
    wait_for_captures(page, 1)
    assert stored_run(stations, "VIN-AGED")["id"] == run["id"]
    end(page)


def test_a_camera_that_stalls_and_one_that_is_unplugged_lose_no_capture(
    chromium: Browser, stations: Serving, shots: Path
) -> None:
    page = begin(reactive_page(chromium), stations, "cable", "VIN-STALLED")
    wait_for_captures(page, 1)
    page.evaluate("window.reactive.paused = true")
    expect(page.locator("[data-problem]")).to_contain_text("No picture comes from the camera")
    page.screenshot(path=shots / "kiosk-stalled.png")
    page.evaluate("window.reactive.paused = false")
    expect(page.locator("[data-problem]")).to_have_count(0)

    page.evaluate("window.reactive.gone = true")
    expect(page.locator("[data-problem]")).to_contain_text("Plug it in, then load the page again")
    before = taken(page)
    page.reload()
    wait_for_captures(page, before + 1)
    assert stored_run(stations, "VIN-STALLED")["captures"] >= 2
    end(page)
