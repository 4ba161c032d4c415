"""The kiosk as a tool: its language, its voice, its rest, practice, and what axe finds on every screen."""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.access import Access
from tests.browser.chromium import Watch, find_chromium
from tests.browser.kiosk_station import (
    open_kiosk,
    prepare_stations,
    scan,
    scan_label,
    stored_run,
    verdict_of,
    wait_for_captures,
    wait_for_hint,
)
from tests.browser.serving import Serving, prepare_service

# Fast hands: what is looked at here does not depend on how they move.
SPEED = 12.0
POSES = 4
# So few poses do not cover the image.
LIMITS = {"coverage": 0.1, "half_difference": 9.0, "held_out_ratio": 9.0}
SMALLEST_BUTTON = """Math.min(...[...document.querySelectorAll('.kiosk button')]
    .filter(button => button.offsetParent !== null)
    .flatMap(button => [button.getBoundingClientRect().height, button.getBoundingClientRect().width]))"""
# Without a sound card nobody hears whether one instruction runs over another one.
RECORDED_VOICE = """
    window.said = [];
    window.SpeechSynthesisUtterance = class { constructor(text) { this.text = text; } };
    const voice = {
        until: 0, pending: false, getVoices: () => [], cancel() { this.until = 0; },
        get speaking() { return performance.now() < this.until; },
        speak(utterance) {
            window.said.push({ text: utterance.text, lang: utterance.lang, isOver: this.speaking });
            this.until = performance.now() + 700;
        },
    };
    Object.defineProperty(window, 'speechSynthesis', { value: voice });
"""


@pytest.fixture(scope="module")
def stations(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service with virtual stations."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("tools"), virtual_speed=SPEED)
    service.start()
    prepare_stations(service, POSES, LIMITS)
    yield service
    service.stop()


def abort(page: Page) -> None:
    """Leave the run that is open, so that the station is free."""
    page.get_by_role("button", name="Abort", exact=False).click()
    page.get_by_role("button", name="Abort the run").click()
    expect(page.get_by_label("Serial", exact=True)).to_be_visible()


def test_every_screen_of_a_vehicles_run_can_be_used_by_everybody(
    page: Page, stations: Serving, watch: Watch, shots: Path, access: Access
) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    open_kiosk(page, stations)
    access.look(page, "start")
    page.screenshot(path=shots / "tool-start.png")
    assert page.evaluate(SMALLEST_BUTTON) >= 72
    scan(page, "VIN-TOOL-1", sku="strict")
    # The run must not be over before all has been looked at.
    automatic = page.get_by_role("button", name="Auto")
    automatic.click()
    expect(automatic).to_have_attribute("aria-pressed", "false")
    wait_for_hint(page, lambda code: code != "")
    assert page.evaluate(SMALLEST_BUTTON) >= 72
    access.look(page, "guide")
    page.screenshot(path=shots / "tool-guide.png")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_be_visible()
    access.look(page, "question")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    automatic.click()
    expect(verdict_of(page)).to_contain_text("FAIL")
    access.look(page, "verdict")
    page.get_by_role("button", name="Next vehicle").click()
    expect(page.get_by_label("Serial", exact=True)).to_be_visible()
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_practice_has_a_score_and_a_best_and_counts_for_nobody(
    page: Page, stations: Serving, watch: Watch, shots: Path, access: Access
) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    open_kiosk(page, stations, "line2")
    page.get_by_role("button", name="tiny", exact=True).click()
    page.get_by_role("button", name="Practise").click()
    expect(page.get_by_label("Badge", exact=True)).to_be_focused()
    access.look(page, "practice")
    page.keyboard.type("badge 4711")
    page.keyboard.press("Enter")
    bar = page.get_by_role("region", name="Practice")
    expect(bar).to_contain_text("par 6 s")
    wait_for_captures(page, 2)
    serial = page.locator(".whose-serial").inner_text()
    access.look(page, "practice run")
    page.screenshot(path=shots / "tool-practice.png")

    result = page.locator("[data-practice]")
    expect(result).to_contain_text("Your new best!", timeout=150_000)
    access.look(page, "practice result")
    page.screenshot(path=shots / "tool-practice-result.png")
    run = stored_run(stations, serial)
    assert (run["state"], run["purpose"], run["captures"]) == ("finished", "simulated", POSES)
    (best,) = page.evaluate("Object.entries(JSON.parse(localStorage['dmscal.kiosk.practice']))")
    assert best[0] == f"tiny/{POSES}/badge 4711"
    assert 100 < best[1]["points"] == int(result.get_attribute("data-practice") or 0)
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
    # Whoever scans a vehicle now goes on with it: practice is over.
    scan_label(page, "VIN-TOOL-2")
    expect(page.locator(".whose-serial")).to_have_text("VIN-TOOL-2")
    expect(bar).to_have_count(0)
    abort(page)


def test_a_station_speaks_its_language_until_somebody_switches(
    page: Page, stations: Serving, watch: Watch, shots: Path
) -> None:
    page.goto(f"{stations.url}/#key={stations.key}")
    page.goto(f"{stations.url}/#/stations")
    choice = page.get_by_label("Kiosk of own speaks")
    choice.select_option(label="中文")
    expect(choice).to_be_enabled()
    expect(choice).to_have_value("zh")

    page.goto(f"{stations.url}/kiosk?station=own")
    expect(page.get_by_role("heading", level=1)).to_have_text("扫描车辆")
    page.screenshot(path=shots / "tool-chinese-start.png")
    assert page.evaluate("document.documentElement.lang") == "zh-Hans"
    page.get_by_role("button", name="English").click()
    page.reload()
    expect(page.get_by_role("heading", level=1)).to_have_text("Scan the vehicle")
    page.goto(f"{stations.url}/#/stations")
    choice.select_option("")
    expect(choice).to_be_enabled()
    expect(choice).to_have_value("")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_the_voice_says_each_instruction_once_and_never_over_another(
    page: Page, stations: Serving, shots: Path
) -> None:
    page.add_init_script(RECORDED_VOICE)
    page.add_init_script("localStorage.setItem('dmscal.language', 'zh')")
    page.set_viewport_size({"width": 1920, "height": 1080})
    page.goto(f"{stations.url}/kiosk?station=line1#key={stations.key}")
    voice = page.get_by_role("button", name="语音")
    expect(voice).to_have_attribute("aria-pressed", "false")
    voice.click()
    page.get_by_role("button", name="tiny", exact=True).click()
    page.keyboard.type("VIN-TOOL-3")
    page.keyboard.press("Enter")
    expect(page.locator(".whose-serial")).to_have_text("VIN-TOOL-3")
    page.screenshot(path=shots / "tool-chinese-guide.png")
    # A capture would take away what is to be said.
    automatic = page.get_by_role("button", name="自动")
    automatic.click()
    expect(automatic).to_have_attribute("aria-pressed", "false")
    # What stands long enough to be said: another vehicle's label, and at the latest the result.
    scan_label(page, "VIN-TOOL-9")
    page.wait_for_function("() => window.said.some(({ text }) => text.startsWith('这里正在标定另一辆车'))")
    page.get_by_role("button", name="知道了").click()
    automatic.click()
    page.wait_for_function("() => window.said.length >= 2", timeout=60_000)

    said = page.evaluate("window.said")
    assert {one["lang"] for one in said} == {"zh-CN"}
    assert not any(one["isOver"] for one in said)
    assert all(one["text"] != after["text"] for one, after in pairwise(said))


def test_nobody_there_rests_the_screen_and_a_scan_wakes_it_without_losing_a_letter(
    page: Page, stations: Serving, shots: Path, access: Access
) -> None:
    page.add_init_script("delete window.speechSynthesis; delete window.SpeechSynthesisUtterance")
    page.clock.install()
    open_kiosk(page, stations, "line2")
    expect(page.get_by_role("button", name="Voice")).to_have_count(0)
    page.clock.run_for(95_000)
    rest = page.get_by_text("Ready for the next vehicle")
    expect(rest).to_be_visible()
    access.look(page, "idle")
    page.screenshot(path=shots / "tool-idle.png")
    rest.click()
    expect(rest).to_have_count(0)
    expect(page.get_by_label("Serial", exact=True)).to_be_focused()
    page.clock.run_for(95_000)
    expect(rest).to_be_visible()

    page.keyboard.type("VIN-TOOL-4")

    expect(rest).to_have_count(0)
    expect(page.get_by_label("Serial", exact=True)).to_have_value("VIN-TOOL-4")
    assert not access.found, "\n".join(access.found)


def test_the_dashboards_pages_can_be_used_by_everybody(page: Page, stations: Serving, access: Access) -> None:
    page.goto(f"{stations.url}/#key={stations.key}")
    run = stored_run(stations, "VIN-TOOL-1")
    page.goto(f"{stations.url}/#/skus/tiny")
    page.get_by_role("link", name="Review this set").click()
    expect(page.get_by_role("heading", name="Coverage")).to_be_visible()
    access.look(page, "pose set")
    for address, ready in (
        ("runs", "VIN-TOOL-1"),
        (f"runs/{run['id']}", "Intrinsics"),
        ("stations", "Station line1"),
        ("skus", "tiny"),
        ("skus/tiny", "Predicted accuracy"),
        ("yield", "No run counts yet"),
    ):
        page.goto(f"{stations.url}/#/{address}")
        expect(page.get_by_text(ready, exact=False).first).to_be_visible()
        access.look(page, address)
    assert not access.found, "\n".join(access.found)
