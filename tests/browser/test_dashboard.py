"""What a person sees on the dashboard, in a real browser against the real service."""

from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.calibrated import Runs
from tests.browser.chromium import Watch
from tests.browser.pixels import pixels_of
from tests.browser.serving import Serving

NAMELESS_CONTROLS = """[...document.querySelectorAll('button, a, input, select')]
    .filter(control => !(control.innerText || control.ariaLabel || control.labels?.length))
    .map(control => control.outerHTML)"""


def open_run(page: Page, serving: Serving, run_id: str) -> None:
    """Open a run with the key in the address, and wait until its corners have been loaded and drawn."""
    page.goto(f"{serving.url}/#key={serving.key}&/runs/{run_id}")
    expect(page.locator(".banner")).to_be_visible()
    expect(page.locator(".thumbnail img").first).to_be_visible()


def test_the_key_is_asked_for_and_opens_the_list_of_runs(
    page: Page, serving: Serving, runs: Runs, watch: Watch, shots: Path
) -> None:
    page.goto(serving.url)
    page.screenshot(path=shots / "key.png")
    page.get_by_label("Key", exact=True).fill(serving.key)
    page.get_by_role("button", name="Open").click()

    table = page.get_by_role("table")
    expect(table.get_by_role("row")).to_have_count(4)
    expect(table.get_by_role("row").nth(1)).to_contain_text("VIN-OPEN-0003")
    expect(table.get_by_role("row", name="VIN-PASS-0001")).to_contain_text("PASS")
    expect(table.get_by_role("row", name="VIN-FAIL-0002")).to_contain_text("FAIL")
    page.screenshot(path=shots / "runs.png")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_wrong_key_is_refused_with_the_reason_and_forgotten(
    page: Page, serving: Serving, shots: Path
) -> None:
    page.goto(f"{serving.url}/#key=dmscal_00000000_wrong")

    expect(page.get_by_role("alert")).to_contain_text("not known or was revoked")
    page.screenshot(path=shots / "key-refused.png")
    assert page.evaluate("sessionStorage.length") == 0


def test_a_key_in_the_address_is_taken_out_of_it(page: Page, serving: Serving, runs: Runs) -> None:
    page.goto(f"{serving.url}/#key={serving.key}&/runs?serial=VIN-PASS-0001")

    expect(page.get_by_role("link", name="VIN-PASS-0001")).to_be_visible()
    assert page.url == f"{serving.url}/#/runs?serial=VIN-PASS-0001"
    expect(page.get_by_role("row")).to_have_count(2)


def test_a_passed_run_shows_verdict_gates_and_intrinsics_of_its_result(
    page: Page, serving: Serving, runs: Runs, watch: Watch, shots: Path
) -> None:
    result = runs.passing
    assert result["verdict"] == "PASS"
    open_run(page, serving, result["run_id"])

    expect(page.get_by_role("heading", level=1)).to_contain_text("PASS VIN-PASS-0001")
    expect(page.locator("tr.gate")).to_have_count(len(result["gates"]))
    fx = page.locator(".intrinsics tbody tr").first.get_by_role("cell")
    assert float(fx.nth(0).inner_text()) == pytest.approx(result["intrinsics"]["fx"], abs=0.06)
    assert float(fx.nth(1).inner_text().removeprefix("± ")) == pytest.approx(result["sd"]["fx"], rel=0.1)
    expect(page.locator(".views tbody tr")).to_have_count(len(result["views"]))
    expect(page.locator(".residuals-panel .panel-head")).to_contain_text("648 corners")
    page.screenshot(path=shots / "run-pass.png", full_page=True)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_failed_run_says_why_above_everything_else(
    page: Page, serving: Serving, runs: Runs, watch: Watch, shots: Path
) -> None:
    failing = [gate for gate in runs.failing["gates"] if gate["verdict"] == "FAIL"]
    assert any(gate["name"] == "edge_width_px" for gate in failing)
    open_run(page, serving, runs.failing["run_id"])

    expect(page.get_by_role("heading", level=1)).to_contain_text("FAIL VIN-FAIL-0002")
    reasons = page.locator(".reasons")
    expect(reasons).to_contain_text("Edge width")
    expect(reasons).to_contain_text(failing[0]["advice"])
    page.get_by_label("Language").select_option("de")
    expect(reasons).to_contain_text("Ansichten sind unscharf. Die Linse scharf stellen")
    expect(page.locator(".gates [lang=en]")).to_have_count(0)
    page.get_by_label("Sprache").select_option("en")
    page.get_by_role("button", name="Not passed").click()
    expect(page.locator("tr.gate-PASS")).to_have_count(0)
    expect(page.locator("tr.gate-FAIL")).to_have_count(len(failing))
    page.screenshot(path=shots / "run-fail.png", full_page=True)
    assert (watch.errors, watch.outside) == ([], [])


def test_images_and_drawings_are_really_drawn(page: Page, serving: Serving, runs: Runs, shots: Path) -> None:
    open_run(page, serving, runs.passing["run_id"])
    expect(page.locator(".residuals-panel .panel-head")).to_contain_text("648 corners")

    loaded = "images => images.map(image => image.complete && image.naturalWidth)"
    assert set(page.locator(".thumbnail img").evaluate_all(loaded)) == {1280}
    page.wait_for_timeout(300)
    viewer = pixels_of(page.locator(".viewer canvas"))
    grey = (np.ptp(viewer.astype(int), axis=2) < 12).mean()
    assert 0.5 < grey < 0.999
    assert _share_of(viewer, (86, 180, 233)) > 0.0003  # circles: detected
    assert _share_of(viewer, (240, 228, 66)) > 0.0002  # crosses: reprojected
    assert _share_of(viewer, (255, 122, 47)) > 0.0003  # residuals
    page.get_by_role("checkbox", name="Residuals").uncheck()
    assert _share_of(pixels_of(page.locator(".viewer canvas")), (255, 122, 47)) < 0.0001
    scatter = pixels_of(page.locator(".scatter canvas"))
    assert _share_of(scatter, (184, 67, 0)) > 0.002  # the chosen view's diamonds
    assert (
        len(np.unique(pixels_of(page.locator(".residuals-panel .field canvas")).reshape(-1, 3), axis=0)) > 20
    )


def test_the_viewer_zooms_by_wheel_and_keys_and_reads_corners_out(
    page: Page, serving: Serving, runs: Runs, shots: Path
) -> None:
    open_run(page, serving, runs.passing["run_id"])
    page.locator(".views tbody button").nth(2).click()
    expect(page.locator(".thumbnail").nth(2)).to_have_attribute("aria-pressed", "true")
    view = runs.passing["views"][2]
    corner = _first_corner(page, serving, view["capture_id"])
    place = page.locator(".viewer-place")
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    assert box is not None
    page.mouse.move(
        box["x"] + box["width"] * (corner[0] + 0.5) / 1280, box["y"] + box["height"] * (corner[1] + 0.5) / 800
    )

    expect(page.locator(".viewer-foot output")).to_contain_text(
        f"Corner 0 at {corner[0]:.2f}, {corner[1]:.2f}"
    )
    before = page.locator(".zoom-value").inner_text()
    page.mouse.wheel(0, -1200)
    expect(page.locator(".zoom-value")).not_to_have_text(before)
    # What was under the pointer stays under it.
    expect(page.locator(".viewer-foot output")).to_contain_text("Corner 0 at")
    page.wait_for_timeout(200)
    page.screenshot(path=shots / "zoomed.png")
    place.focus()
    page.keyboard.press("0")
    expect(page.locator(".zoom-value")).to_have_text(before)


def test_the_page_can_be_used_by_keyboard_and_every_control_has_a_name(
    page: Page, serving: Serving, runs: Runs
) -> None:
    open_run(page, serving, runs.passing["run_id"])
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Skip to content")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator("main")).to_be_focused()

    assert page.evaluate(NAMELESS_CONTROLS) == []
    assert (
        page.evaluate("[...document.querySelectorAll('th')].filter(th => !th.scope && !th.ariaHidden).length")
        == 0
    )
    for role in ("banner", "navigation", "main"):
        expect(page.get_by_role(role).first).to_be_visible()


def test_an_open_run_says_how_far_it_is_and_offers_no_verdict(
    page: Page, serving: Serving, runs: Runs, watch: Watch, shots: Path
) -> None:
    open_run(page, serving, runs.open_id)

    expect(page.get_by_role("heading", level=1)).to_contain_text("OPEN")
    expect(page.locator(".banner")).to_contain_text("1 of 12 captures")
    expect(page.locator(".gates-panel")).to_have_count(0)
    page.screenshot(path=shots / "run-open.png", full_page=True)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_german_dark_and_narrow_show_the_same(page: Page, serving: Serving, runs: Runs, shots: Path) -> None:
    open_run(page, serving, runs.failing["run_id"])
    page.get_by_label("Language").select_option("de")
    page.get_by_role("button", name="Dunkel").click()

    expect(page.get_by_role("heading", level=1)).to_contain_text("SCHLECHT")
    expect(page.locator("html")).to_have_attribute("lang", "de")
    page.wait_for_timeout(300)
    page.screenshot(path=shots / "run-german-dark.png", full_page=True)
    page.set_viewport_size({"width": 420, "height": 900})
    page.wait_for_timeout(300)
    page.screenshot(path=shots / "run-narrow.png", full_page=True)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.reload()
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")


def test_a_vehicle_shows_its_runs_and_an_unknown_one_what_to_do(
    page: Page, serving: Serving, runs: Runs
) -> None:
    open_run(page, serving, runs.passing["run_id"])
    page.get_by_role("link", name="History of this vehicle").click()

    expect(page.get_by_role("heading", level=1)).to_contain_text("VIN-PASS-0001")
    expect(page.locator("table.runs").get_by_role("row")).to_have_count(2)
    page.goto(f"{serving.url}/#/vehicles/NOBODY")
    expect(page.get_by_role("alert")).to_contain_text("Serials are compared exactly")


def test_a_serial_without_runs_is_said_and_a_run_that_is_not_there_too(
    page: Page, serving: Serving, runs: Runs, shots: Path
) -> None:
    page.goto(f"{serving.url}/#key={serving.key}")
    page.get_by_label("Serial").fill("NOBODY")
    page.keyboard.press("Enter")

    expect(page.locator(".notice-empty")).to_contain_text("NOBODY")
    page.screenshot(path=shots / "runs-none.png")
    page.goto(f"{serving.url}/#/runs/00000000-0000-7000-8000-000000000000")
    expect(page.get_by_role("alert")).to_contain_text("no run of this id")
    page.screenshot(path=shots / "problem.png")


def test_a_page_outlives_the_service_and_goes_on_when_it_is_back(
    page: Page, serving: Serving, runs: Runs, shots: Path
) -> None:
    page.goto(f"{serving.url}/#key={serving.key}")
    expect(page.get_by_role("row")).to_have_count(4)
    serving.stop()
    try:
        expect(page.get_by_role("alert")).to_contain_text("No server")
        expect(page.get_by_role("row")).to_have_count(4)
        expect(page.locator(".live")).to_have_count(0)
        page.screenshot(path=shots / "offline.png")
    finally:
        serving.start()

    expect(page.get_by_role("alert")).to_have_count(0)
    expect(page.get_by_role("row")).to_have_count(4)


def _first_corner(page: Page, serving: Serving, capture_id: str) -> tuple[float, float]:
    answer = page.request.get(
        f"{serving.url}/api/v1/captures/{capture_id}", headers={"Authorization": f"Bearer {serving.key}"}
    )
    u, v = answer.json()["corners"][0]
    return float(u), float(v)


def _share_of(pixels: np.ndarray, colour: tuple[int, int, int]) -> float:
    near = np.abs(pixels.astype(int) - np.array(colour)).max(axis=2) < 12
    return float(near.mean())
