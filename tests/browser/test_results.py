"""From a strange point to its image, errors over the image, histories, and two runs side by side."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, Position, expect

from tests.browser.access import Access
from tests.browser.calibrated import Runs
from tests.browser.chromium import Watch
from tests.browser.pixels import pixels_of
from tests.browser.serving import Serving
from tests.browser.test_dashboard import open_run


def ask(page: Page, serving: Serving, path: str) -> Any:
    """The service's own answer."""
    return page.request.get(
        f"{serving.url}/api/v1{path}", headers={"Authorization": f"Bearer {serving.key}"}
    ).json()


def corners_of(page: Page, serving: Serving, run: dict[str, Any]) -> list[tuple[float, int, int, Any]]:
    """Residual, capture, corner and reprojection of all corners of a run, the longest residual first."""
    found = []
    for number, view in enumerate(run["views"], start=1):
        capture = ask(page, serving, f"/captures/{view['capture_id']}")
        apart = np.array(capture["corners"]) - np.array(capture["reprojected"])
        for corner, length in enumerate(np.linalg.norm(apart, axis=1)):
            found.append((float(length), number, corner, capture["reprojected"][corner]))
    return sorted(found, key=lambda one: -one[0])


def open_loaded(page: Page, serving: Serving, run_id: str) -> None:
    """Open a run and wait until all its corners are there."""
    open_run(page, serving, run_id)
    expect(page.locator(".residuals-panel .panel-head")).to_contain_text("648 corners")


def test_one_press_leads_from_a_strange_residual_to_its_corner_in_its_image(
    page: Page, serving: Serving, runs: Runs, watch: Watch, shots: Path
) -> None:
    open_loaded(page, serving, runs.passing["run_id"])
    length, number, corner, (u, v) = corners_of(page, serving, runs.passing)[0]
    field = page.locator(".residuals-panel .field .pointable")
    field.scroll_into_view_if_needed()
    box = field.bounding_box()
    assert box is not None
    width, height = box["width"] - 2, box["height"] - 2
    at = Position(x=1 + (u + 0.5) * width / 1280, y=1 + (v + 0.5) * height / 800)
    field.hover(position=at)
    read = page.locator(".residuals-panel .pointed-read").inner_text()

    field.click(position=at)

    # Corners of several views may lie on one another: what was read is what is shown.
    capture, shown = (int(part.split()[1]) for part in read.split(":")[0].split(", "))
    expect(page.locator(".thumbnail").nth(capture - 1)).to_have_attribute("aria-pressed", "true")
    expect(page.locator(".viewer-foot")).to_contain_text(f"Corner {shown} at")
    expect(page.locator(".zoom-value")).to_have_text("8.00×")
    longest = page.get_by_role("list", name="Longest residuals").get_by_role("button").first
    expect(longest).to_have_text(f"Capture {number}, corner {corner}")
    longest.focus()
    page.keyboard.press("Enter")
    page.mouse.move(0, 0)
    expect(longest).to_have_attribute("aria-pressed", "true")
    expect(page.locator(".viewer-foot")).to_contain_text(f"({length:.3f} px)")
    page.wait_for_timeout(300)
    page.screenshot(path=shots / "strange-corner.png")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_residual_of_the_cloud_leads_to_its_corner_and_each_view_has_a_field(
    page: Page, serving: Serving, runs: Runs, shots: Path
) -> None:
    open_loaded(page, serving, runs.passing["run_id"])
    cloud = page.locator(".pointable.scatter")
    cloud.scroll_into_view_if_needed()
    box = cloud.bounding_box()
    assert box is not None
    zero = Position(x=46 + (box["width"] - 58) / 2, y=10 + (box["width"] - 58) / 2)
    cloud.hover(position=zero)
    read = page.locator(".scatter-figure .pointed-read")
    expect(read).to_contain_text("corner")
    corner = read.inner_text().split("corner ")[1].split(":")[0]
    cloud.click(position=zero)

    expect(page.locator(".viewer-foot")).to_contain_text(f"Corner {corner} at")
    page.get_by_role("button", name="by view").click()
    fields = page.locator(".view-field")
    expect(fields).to_have_count(12)
    fields.nth(4).click()
    expect(page.locator(".thumbnail").nth(4)).to_have_attribute("aria-pressed", "true")
    page.wait_for_timeout(200)
    assert len(np.unique(pixels_of(fields.nth(4)).reshape(-1, 3), axis=0)) > 20


def test_the_image_is_moved_and_zoomed_by_keys_mouse_and_two_fingers(
    page: Page, serving: Serving, runs: Runs
) -> None:
    open_loaded(page, serving, runs.passing["run_id"])
    place, zoom = page.locator(".viewer-place"), page.locator(".zoom-value")
    canvas = place.bounding_box()
    assert canvas is not None
    whole = min(canvas["width"] / 1280, canvas["height"] / 800)
    place.focus()
    page.keyboard.press("+")
    expect(zoom).to_have_text(f"{1.5 * whole:.2f}×")
    assert moves(place, lambda: page.keyboard.press("ArrowRight"))
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag() -> None:
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 80, y + 40, steps=4)
        page.mouse.up()

    assert moves(place, drag)
    page.keyboard.press("-")
    page.keyboard.press("0")
    expect(zoom).to_have_text(f"{whole:.2f}×")
    pinch(page, x, y, 50, 150)
    expect(zoom).to_have_text(f"{3 * whole:.2f}×")


def moves(place: Locator, act: Any) -> bool:
    """Whether an act moves what is in the image."""
    before = pixels_of(place).astype(int)
    act()
    place.page.wait_for_timeout(200)
    return bool((np.abs(pixels_of(place).astype(int) - before).max(axis=2) > 40).mean() > 0.02)


def pinch(page: Page, x: float, y: float, begin: float, end: float) -> None:
    """Put two fingers on a page and move them apart."""
    session = page.context.new_cdp_session(page)
    for kind, apart in [("touchStart", begin), *(("touchMove", d) for d in np.linspace(begin, end, 6))]:
        fingers = [{"x": x - float(apart), "y": y, "id": 0}, {"x": x + float(apart), "y": y, "id": 1}]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def test_a_run_shows_its_errors_over_the_image_and_its_pictures_elsewhere(
    page: Page, serving: Serving, runs: Runs, watch: Watch
) -> None:
    open_loaded(page, serving, runs.passing["run_id"])
    maps = ask(page, serving, f"/runs/{runs.passing['run_id']}/result/maps")
    panel = page.get_by_role("region", name="Error over the image")
    expected = panel.locator(".heat").first.locator(".field")
    expected.scroll_into_view_if_needed()
    box = expected.bounding_box()
    assert box is not None
    expected.hover(position={"x": 10.5 / 40 * box["width"], "y": 7.5 / 25 * box["height"]})

    expect(panel.locator(".heat-read").first).to_contain_text(f"{maps['sd_px'][7][10]:.2g}"[:5])
    expect(panel.locator(".heat-read").first).to_contain_text("mdeg")
    panel.get_by_role("button", name="mdeg").click()
    expect(panel.locator(".heat-scale").first).to_contain_text("mdeg")
    expect(panel.locator(".heat-scale").last).to_contain_text("px")
    shared = page.get_by_role("region", name="Pictures that other runs hold too")
    expect(shared).to_contain_text("1 picture is also in VIN-OPEN-0003")
    shared.get_by_role("link", name="Capture 1 is capture 1 there").click()
    expect(page.get_by_role("heading", level=1)).to_contain_text("VIN-OPEN-0003")
    expect(page.get_by_role("region", name="Pictures that other runs")).to_contain_text("VIN-PASS-0001")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_two_runs_are_ticked_in_the_list_and_compared(
    page: Page, serving: Serving, runs: Runs, watch: Watch, shots: Path, access: Access
) -> None:
    page.goto(f"{serving.url}/#key={serving.key}")
    page.get_by_role("checkbox", name="VIN-PASS-0001").check()
    expect(page.get_by_role("status").filter(has_text="To compare")).to_contain_text("Choose one more run")
    page.get_by_role("checkbox", name="VIN-FAIL-0002").check()
    access.look(page, "runs")
    page.get_by_role("link", name="Compare the two").click()

    ids = runs.passing["run_id"], runs.failing["run_id"]
    assert page.url.endswith("#/compare?a={}&b={}".format(*ids))
    found = ask(page, serving, "/runs/{}/comparison/{}".format(*ids))
    row = page.locator(".parameters-compared tbody tr").first
    expect(row).to_contain_text(f"{found['parameters'][0]['apart_sd']:+.1f}".replace("-", "−"))
    zone = page.get_by_role("row", name="Working zone")
    expect(zone).to_contain_text(f"{found['working_zone']['worst_px']:.3g}")
    expect(page.locator(".gates-compared tbody tr")).to_have_count(len(runs.passing["gates"]))
    page.get_by_role("button", name="Not passed").click()
    expect(page.locator(".gates-compared")).to_contain_text("FAIL")
    page.wait_for_timeout(300)
    assert len(np.unique(pixels_of(page.locator(".heat .field")).reshape(-1, 3), axis=0)) > 100
    assert (
        len(np.unique(pixels_of(page.locator(".field-figure:not(.heat) .field")).reshape(-1, 3), axis=0)) > 20
    )
    access.look(page, "compare")
    page.screenshot(path=shots / "compare.png", full_page=True)
    page.get_by_role("link", name="B ⇄ A").click()
    expect(page.locator("th", has_text="A ·")).to_contain_text("VIN-FAIL-0002")
    page.set_viewport_size({"width": 420, "height": 900})
    page.get_by_label("Language").select_option("de")
    page.wait_for_timeout(300)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_what_cannot_be_compared_is_said(page: Page, serving: Serving, runs: Runs) -> None:
    page.goto(f"{serving.url}/#key={serving.key}&/compare")
    expect(page.locator(".notice-empty")).to_contain_text("Tick two finished runs")
    page.goto(f"{serving.url}/#/compare?a={runs.passing['run_id']}&b={runs.open_id}")
    expect(page.locator(".notice-empty")).to_contain_text("Run B has no result yet")
    page.route("**/comparison/**", lambda route: route.fulfill(json=_of_two_lenses(route.fetch().json())))
    page.goto(f"{serving.url}/#/compare?a={runs.passing['run_id']}&b={runs.failing['run_id']}")
    expect(page.locator(".notice-problem")).to_contain_text("A: pinhole5, B: rational8")
    expect(page.get_by_role("row", name="Working zone")).to_be_visible()
    expect(page.locator(".parameters-compared")).to_have_count(0)


def _of_two_lenses(comparison: dict[str, Any]) -> dict[str, Any]:
    return {**comparison, "lens_b": "rational8", "parameters": [], "distance_sd": None}


@pytest.mark.parametrize("theme", ["Light", "Dark"])
def test_the_history_of_a_vehicle_has_a_chart_for_each_quantity_that_leads_to_the_run(
    page: Page, serving: Serving, runs: Runs, watch: Watch, access: Access, theme: str
) -> None:
    page.goto(f"{serving.url}/#key={serving.key}&/vehicles/VIN-PASS-0001")
    page.get_by_role("button", name=theme).click()
    charts = page.locator(".history-chart canvas")
    expect(charts).to_have_count(5)
    fx, sd = (runs.passing[part]["fx"] for part in ("intrinsics", "sd"))
    decimals = 1 - math.floor(math.log10(sd))  # two digits of what is uncertain
    expect(page.locator("table.history tbody tr")).to_contain_text(f"{fx:.{decimals}f}")
    page.wait_for_timeout(300)
    green = (0, 117, 88) if theme == "Light" else (43, 196, 151)
    near = np.abs(pixels_of(charts.first).astype(int) - np.array(green)).max(axis=2) < 12
    assert near.sum() > 60
    if theme == "Light":
        access.look(page, "vehicle")
        assert not access.found, "\n".join(access.found)
    box = charts.first.bounding_box()
    assert box is not None
    charts.first.hover(position={"x": 68 + (box["width"] - 80) / 2, "y": box["height"] / 2}, force=True)
    expect(page.locator(".history-figure").first).to_contain_text("PASS")
    page.mouse.down()
    page.mouse.up()
    expect(page.locator(".banner")).to_contain_text("VIN-PASS-0001")
    expect(page.get_by_role("region", name="History of VIN-PASS-0001")).to_contain_text("this run")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
