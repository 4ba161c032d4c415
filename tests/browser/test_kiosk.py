"""A vehicle at a virtual station, through the kiosk's page in a real browser against the real service."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, WebSocketRoute, expect

from tests.browser.chromium import Watch, find_chromium
from tests.browser.kiosk_station import (
    POSES,
    SPEED,
    open_kiosk,
    prepare_stations,
    press_while_moving,
    scan,
    scan_label,
    stored_run,
    taken,
    verdict_of,
    wait_for_captures,
    wait_for_hint,
)
from tests.browser.serving import Serving, prepare_service

SMALLEST_BUTTON = """Math.min(...[...document.querySelectorAll('.act, .switch')]
    .map(button => button.getBoundingClientRect().height))"""
WORD_SIZE = "parseFloat(getComputedStyle(document.querySelector('.strip-main')).fontSize)"


@pytest.fixture(scope="module")
def stations(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service with virtual stations."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("stations"), virtual_speed=SPEED)
    service.start()
    prepare_stations(service)
    yield service
    service.stop()


def test_a_run_goes_from_the_serial_to_a_pass_that_is_stored(
    page: Page, stations: Serving, watch: Watch, shots: Path
) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    open_kiosk(page, stations)
    page.screenshot(path=shots / "kiosk-start.png")
    scan(page, "VIN-KIOSK-0001")
    wait_for_hint(page, lambda code: code.startswith(("move", "tilt", "turn", "rotate")))
    assert page.evaluate(SMALLEST_BUTTON) >= 72
    assert page.evaluate(WORD_SIZE) >= 48
    page.screenshot(path=shots / "kiosk-guide.png")
    wait_for_captures(page, 3)
    expect(page.locator(".count")).to_contain_text(f"/{POSES}")

    expect(verdict_of(page)).to_contain_text("PASS")
    page.screenshot(path=shots / "kiosk-pass.png")
    run = stored_run(stations, "VIN-KIOSK-0001")
    assert (run["state"], run["verdict"], run["captures"]) == ("finished", "PASS", POSES)
    page.get_by_role("button", name="Next vehicle").click()
    expect(page.get_by_label("Serial", exact=True)).to_be_visible()
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_camera_that_fails_is_said_to_the_whole_hall_with_what_to_do(
    page: Page, stations: Serving, shots: Path
) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    open_kiosk(page, stations)
    scan(page, "VIN-KIOSK-0002", sku="strict")

    screen = verdict_of(page)
    expect(screen).to_contain_text("FAIL")
    expect(screen).to_contain_text("Do not ship this camera")
    expect(screen.locator(".why li").first).to_contain_text("sd of focal length")
    height = page.evaluate("document.querySelector('.verdict-word').getBoundingClientRect().height")
    assert height > 200
    page.screenshot(path=shots / "kiosk-fail.png")
    assert stored_run(stations, "VIN-KIOSK-0002")["verdict"] == "FAIL"
    page.evaluate("localStorage.setItem('dmscal.language', 'de')")
    page.reload()
    expect(verdict_of(page).locator(".why li").first).to_contain_text("Die Brennweite ist zu unsicher.")
    expect(page.locator(".verdict [lang=en]")).to_have_count(0)
    page.screenshot(path=shots / "kiosk-fail-german.png")
    page.evaluate("localStorage.removeItem('dmscal.language')")
    page.reload()
    expect(verdict_of(page)).to_contain_text("FAIL")
    # Whoever scans at a verdict goes on with the next vehicle, without a button.
    scan_label(page, "VIN-KIOSK-0022")
    expect(page.locator(".whose-serial")).to_have_text("VIN-KIOSK-0022")
    _abort(page)


def test_keys_alone_are_enough(page: Page, stations: Serving) -> None:
    open_kiosk(page, stations, "line2")
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="long", exact=True)).to_be_focused()
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="strict", exact=True)).to_be_focused()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Enter")
    expect(page.get_by_label("Serial", exact=True)).to_be_focused()
    page.keyboard.type("VIN-KIOSK-0003")
    page.keyboard.press("Enter")
    wait_for_captures(page, 2)
    page.keyboard.press("Backspace")
    expect(page.locator(".tile-taken")).to_have_count(1)
    press_while_moving(page, " ")
    expect(page.locator("[data-problem]")).to_contain_text("Not taken")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_contain_text("Abort this run?")
    expect(page.get_by_role("button", name="Go on")).to_be_focused()
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    # However fast it is pressed, every Escape counts: opened, closed, …, opened.
    for _ in range(7):
        page.keyboard.press("Escape")
    expect(page.get_by_role("button", name="Go on")).to_be_focused()
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Abort the run")).to_be_focused()
    page.keyboard.press("Enter")

    expect(page.get_by_label("Serial", exact=True)).to_be_visible()
    assert stored_run(stations, "VIN-KIOSK-0003")["state"] == "aborted"


def test_a_reload_in_mid_run_goes_on_at_the_same_pose(page: Page, stations: Serving) -> None:
    open_kiosk(page, stations)
    scan(page, "VIN-KIOSK-0004", sku="long")
    wait_for_captures(page, 2)
    before = taken(page)
    page.reload()

    expect(page.locator(".whose-serial")).to_have_text("VIN-KIOSK-0004")
    assert taken(page) >= before
    wait_for_captures(page, before + 1)
    run = stored_run(stations, "VIN-KIOSK-0004")
    assert run["state"] == "open"
    _abort(page)


def test_the_run_outlives_the_service_and_goes_on_by_itself(
    page: Page, stations: Serving, shots: Path
) -> None:
    open_kiosk(page, stations)
    scan(page, "VIN-KIOSK-0005", sku="long")
    wait_for_captures(page, 1)
    before = taken(page)
    stations.stop()
    try:
        expect(page.get_by_role("alert")).to_contain_text("No server")
        page.screenshot(path=shots / "kiosk-lost.png")
    finally:
        stations.start()

    expect(page.locator(".lost")).to_have_count(0)
    assert taken(page) >= before
    wait_for_captures(page, before + 1)
    _abort(page)


def test_a_mirrored_display_swaps_picture_arrows_and_words(page: Page, stations: Serving) -> None:
    open_kiosk(page, stations)
    scan(page, "VIN-KIOSK-0006", sku="long")
    mirror = page.get_by_role("button", name="Mirror")
    sideways = wait_for_hint(page, lambda code: code in {"move-left", "move-right"})
    # One moment, both displays: the frame that is shown stays while the service is not asked.
    hints = page.evaluate(
        """() => {
            const read = () => document.querySelector('.strip').dataset.hint;
            const before = read();
            [...document.querySelectorAll('.switch')][0].click();
            return new Promise(done => queueMicrotask(() => setTimeout(() => done([before, read()]))));
        }"""
    )
    expect(mirror).to_have_attribute("aria-pressed", "true")
    assert sideways in {"move-left", "move-right"}
    assert set(hints) <= {"move-left", "move-right"}
    assert hints[0] != hints[1]
    page.reload()
    expect(page.get_by_role("button", name="Mirror")).to_have_attribute("aria-pressed", "true")
    page.get_by_role("button", name="Mirror").click()
    _abort(page)


def test_german_and_dark_show_the_same(page: Page, stations: Serving, shots: Path) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    open_kiosk(page, stations)
    page.get_by_role("button", name="Deutsch").click()
    page.get_by_role("button", name="Dunkel").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Fahrzeug scannen")
    page.get_by_label("Seriennummer", exact=True).fill("VIN-KIOSK-0007")
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert")).to_contain_text("Welche Kamera ist es?")
    page.get_by_role("button", name="long", exact=True).click()
    page.keyboard.press("Enter")
    wait_for_hint(page, lambda code: code.startswith(("tilt", "turn")))

    page.screenshot(path=shots / "kiosk-german-dark.png")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert page.evaluate(WORD_SIZE) >= 48
    words = page.locator(".strip-main")
    assert words.evaluate("e => e.scrollHeight <= e.parentElement.parentElement.clientHeight")
    page.get_by_role("button", name="Abbruch").click()
    page.get_by_role("button", name="Lauf abbrechen").click()
    expect(page.get_by_label("Seriennummer", exact=True)).to_be_visible()


def test_a_second_kiosk_on_a_running_run_is_told_who_holds_the_station_and_takes_the_run_over(
    page: Page, stations: Serving, shots: Path
) -> None:
    open_kiosk(page, stations)
    scan(page, "VIN-KIOSK-0008", sku="long")
    second = page.context.new_page()
    second.goto(f"{stations.url}/kiosk?station=line1#key={stations.key}")
    expect(second.get_by_role("alert")).to_contain_text("Another kiosk holds this station", timeout=20_000)
    second.screenshot(path=shots / "kiosk-taken.png")
    wait_for_captures(page, 1)
    page.goto("about:blank")

    expect(second.locator(".whose-serial")).to_have_text("VIN-KIOSK-0008", timeout=20_000)
    assert taken(second) >= 1
    _abort(second)
    second.close()


def test_a_page_of_another_version_is_asked_to_be_loaded_again(page: Page, stations: Serving) -> None:
    def speak_otherwise(route: WebSocketRoute) -> None:
        server = route.connect_to_server()
        route.on_message(lambda said: server.send(str(said).replace('"protocol":1', '"protocol":9')))

    page.route_web_socket("**/guidance", speak_otherwise)
    page.goto(f"{stations.url}/kiosk?station=line1#key={stations.key}")

    expect(page.get_by_role("alert")).to_contain_text("Load the page again")
    expect(page.get_by_role("button", name="Load again")).to_be_visible()


def test_an_unknown_station_and_a_refused_key_say_what_to_do(page: Page, stations: Serving) -> None:
    page.goto(f"{stations.url}/kiosk?station=nowhere#key={stations.key}")
    expect(page.get_by_role("alert")).to_contain_text("This station is not known")
    page.goto("about:blank")
    page.goto(f"{stations.url}/kiosk?station=line1#key=dmscal_00000000_wrong")

    expect(page.get_by_role("alert")).to_contain_text("does not accept the key")
    page.get_by_role("button", name="Enter another key").click()
    expect(page.get_by_label("Key", exact=True)).to_be_visible()


def _abort(page: Page) -> None:
    page.get_by_role("button", name="Abort", exact=False).click()
    page.get_by_role("button", name="Abort the run").click()
    expect(page.get_by_label("Serial", exact=True)).to_be_visible()
