"""Stations, SKUs with their pose sets, and yield, as a person sees them in a real browser."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from service.demo.customer import Customer
from tests.browser.chromium import Watch, find_chromium
from tests.browser.month import SKU, Month, make_month
from tests.browser.pixels import pixels_of
from tests.browser.serving import Serving, prepare_service

NAMELESS_CONTROLS = """[...document.querySelectorAll('button, a, input, select')]
    .filter(control => !(control.innerText || control.ariaLabel || control.labels?.length))
    .map(control => control.outerHTML)"""
PAGES = ("stations", "skus", "skus/lens1", "yield", "runs?counted=true&verdict=FAIL&failed=coverage")


@pytest.fixture(scope="module")
def plant(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """A service of its own: its runs would be too many for the other pages' tests."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("plant"))
    service.start()
    yield service
    service.stop()


@pytest.fixture(scope="module")
def customer(plant: Serving) -> Iterator[Customer]:
    """Who asks the service what the pages should show."""
    made = Customer.of(plant.url, plant.key)
    with made.http:
        yield made


@pytest.fixture(scope="module")
def month(plant: Serving, customer: Customer) -> Month:
    """A month of runs."""
    return make_month(plant, customer)


def go(page: Page, plant: Serving, where: str) -> None:
    """Open a page of the dashboard with the key in the address."""
    page.goto(f"{plant.url}/#key={plant.key}&/{where}")
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    expect(page.get_by_role("status")).to_have_count(0)


def total(found: dict[str, Any], name: str) -> int:
    """The sum of a count over SKUs, stations and days."""
    return sum(int(count[name]) for count in found["counts"])


def test_a_station_shows_its_open_run_its_last_verdict_and_the_way_to_its_kiosk(
    page: Page, plant: Serving, customer: Customer, month: Month, watch: Watch, shots: Path
) -> None:
    go(page, plant, "stations")

    cards = page.get_by_role("listitem")
    expect(cards).to_have_count(3)
    expect(cards.nth(0)).to_contain_text("VIN-NOW-0001")
    expect(cards.nth(0)).to_contain_text(f"1 / {len(month.pose_set['poses'])}")
    expect(cards.nth(0).locator(".done")).to_have_count(1)
    expect(cards.nth(0).locator(".station-last .tag")).to_have_count(1)
    expect(cards.nth(2)).to_contain_text("none yet")
    kiosk = cards.nth(0).get_by_role("link", name="Open kiosk of cal1")
    assert kiosk.get_attribute("href") == "/kiosk?station=cal1"
    page.screenshot(path=shots / "stations.png")

    customer.ask("POST", f"/runs/{month.open_id}/abort")

    expect(cards.nth(0)).to_contain_text("No open run")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_sku_leads_to_its_pose_set_and_what_that_promises(
    page: Page, plant: Serving, month: Month, watch: Watch, shots: Path
) -> None:
    go(page, plant, "skus")
    row = page.get_by_role("row", name=SKU["code"], exact=False).filter(has_text=SKU["name"])
    expect(row).to_contain_text("rev. 1")
    expect(row).to_contain_text(f"{len(month.pose_set['poses'])} poses")
    expect(page.get_by_role("row", name="lens2")).to_contain_text("none published")
    page.screenshot(path=shots / "skus.png")
    row.get_by_role("link").click()

    expect(page.get_by_role("heading", level=1)).to_have_text(SKU["code"])
    expect(page.locator(".poses tbody tr")).to_have_count(len(month.pose_set["poses"]))
    prediction = page.get_by_role("region", name="Predicted accuracy")
    fx = prediction.get_by_role("row").filter(has=page.get_by_role("rowheader", name="fx"))
    shown = float(fx.get_by_role("cell").nth(1).inner_text().removeprefix("± "))
    assert shown == pytest.approx(month.pose_set["prediction"]["sd"]["fx"], rel=0.01)
    expect(prediction).to_contain_text(f"{month.pose_set['prediction']['norm_px']:.3f} px")
    expect(page.get_by_role("region", name="Provenance")).to_contain_text("balanced")
    page.screenshot(path=shots / "sku.png", full_page=True)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_pose_is_picked_by_a_click_into_the_image_and_by_keyboard(
    page: Page, plant: Serving, month: Month, shots: Path
) -> None:
    go(page, plant, f"skus/{SKU['code']}")
    picture = page.locator(".pose-field")
    expect(page.get_by_role("button", name="Pose 1", exact=True)).to_have_attribute("aria-pressed", "true")
    before = pixels_of(picture)

    button = page.get_by_role("button", name="Pose 7", exact=True)
    button.focus()
    page.keyboard.press("Enter")

    expect(button).to_have_attribute("aria-pressed", "true")
    expect(picture.get_by_role("img", name="pose 7 is picked out")).to_be_visible()
    assert np.abs(pixels_of(picture).astype(int) - before).max() > 50
    # Centres of different poses lie apart, so that the centre of an outline means its pose.
    u, v = np.mean(month.pose_set["poses"][2]["outer_corners"], axis=0)
    box = picture.bounding_box()
    assert box is not None
    scale = box["width"] / SKU["image_size"][0]
    picture.click(position={"x": (u + 0.5) * scale, "y": (v + 0.5) * scale})
    expect(page.get_by_role("button", name="Pose 3", exact=True)).to_have_attribute("aria-pressed", "true")
    page.screenshot(path=shots / "sku-pose.png")


def test_a_set_is_reviewed_in_a_browser_that_cannot_draw_in_space(
    page: Page, plant: Serving, month: Month, watch: Watch, shots: Path
) -> None:
    loaded: list[str] = []
    page.on("request", lambda request: loaded.append(request.url))
    go(page, plant, f"skus/{SKU['code']}")
    page.get_by_role("link", name="Review this set").click()

    expect(page.get_by_role("heading", level=1)).to_contain_text("Pose set")
    space = page.get_by_role("region", name="In front of the camera")
    expect(space).to_contain_text("no WebGL")
    expect(page.locator(".poses tbody tr")).to_have_count(len(month.pose_set["poses"]))
    assert not any("space_view" in url for url in loaded)
    page.screenshot(path=shots / "review-flat.png")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_limits_are_shown_as_the_service_judges_by_them(
    page: Page, plant: Serving, customer: Customer, month: Month
) -> None:
    go(page, plant, f"skus/{SKU['code']}")
    rows = page.get_by_role("region", name="Limits").locator("tbody tr")
    limits = customer.ask("GET", f"/skus/{SKU['code']}/revisions/1/limits")["limits"]

    expect(rows).to_have_count(len(limits))
    expect(rows.filter(has_text="Coverage of the zone")).to_contain_text("≥ 0.85")
    expect(rows.filter(has_text="sd of focal length")).to_contain_text("≤ 0.001")


def test_yield_counts_what_the_service_counts_and_its_numbers_lead_to_their_runs(
    page: Page, plant: Serving, customer: Customer, month: Month, watch: Watch, shots: Path
) -> None:
    found = customer.ask("GET", "/statistics/yield")
    first, passed = total(found, "first_runs"), total(found, "first_passed")
    go(page, plant, "yield")

    figures = page.locator(".figures")
    expect(figures).to_contain_text(f"{100 * passed / first:.1f} %")
    expect(figures).to_contain_text(f"{passed} of {first} first runs")
    expect(page.locator(".definition")).to_contain_text("production or retest")
    gates = page.get_by_role("region", name="Failing gates").locator("tbody tr")
    assert [int(row.get_by_role("link").inner_text()) for row in gates.all()] == [
        gate["runs"] for gate in found["gates"]
    ]
    page.screenshot(path=shots / "yield.png", full_page=True)
    page.get_by_role("region", name="Failing gates").get_by_role("link").first.click()

    expect(page.locator("table.runs tbody tr")).to_have_count(found["gates"][0]["runs"])
    expect(page.locator(".chip")).to_have_count(4)
    page.screenshot(path=shots / "runs-conditions.png")
    page.go_back()
    figures.get_by_role("link", name=str(total(found, "failed")), exact=True).click()
    expect(page.locator("table.runs tbody tr")).to_have_count(total(found, "failed"))
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_yield_and_runs_are_narrowed_by_sku_station_and_verdict(
    page: Page, plant: Serving, customer: Customer, month: Month
) -> None:
    go(page, plant, "yield")
    page.get_by_label("SKU", exact=True).select_option("lens2")
    page.get_by_label("Station", exact=True).select_option("cal2")
    found = customer.ask("GET", "/statistics/yield", params={"sku": "lens2", "station": "cal2"})

    expect(page.locator(".figures")).to_contain_text(f"of {total(found, 'first_runs')} first runs")
    assert page.url.endswith("#/yield?sku=lens2&station=cal2")
    page.goto(f"{plant.url}/#/runs")
    page.get_by_label("Verdict", exact=True).select_option("MARGINAL")
    page.get_by_label("Station", exact=True).select_option("cal1")
    wanted = customer.ask("GET", "/runs", params={"verdict": "MARGINAL", "station": "cal1", "limit": 200})
    expect(page.locator("table.runs tbody tr")).to_have_count(len(wanted["items"]))
    page.goto(f"{plant.url}/#/runs?since=2020-01-01&until=2020-01-02")
    expect(page.locator(".notice-empty")).to_contain_text("No run meets these conditions")
    page.get_by_role("link", name=re.compile("Without the condition: to ")).click()
    expect(page.locator("table.runs tbody tr")).not_to_have_count(0)


@pytest.mark.parametrize("where", PAGES)
def test_pages_hold_in_german_in_the_dark_and_on_a_narrow_screen(
    page: Page, plant: Serving, month: Month, watch: Watch, shots: Path, where: str
) -> None:
    go(page, plant, where)
    page.get_by_label("Language").select_option("de")
    page.get_by_role("button", name="Dunkel").click()
    name = re.sub(r"[^a-z0-9]+", "-", where.lower())
    page.screenshot(path=shots / f"{name}-german-dark.png", full_page=True)
    assert page.evaluate(NAMELESS_CONTROLS) == []
    page.set_viewport_size({"width": 420, "height": 900})
    page.wait_for_timeout(300)
    page.screenshot(path=shots / f"{name}-narrow.png", full_page=True)

    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_pages_without_anything_to_show_say_what_to_do(
    page: Page, built_web: Path, tmp_path: Path, shots: Path
) -> None:
    service = prepare_service(tmp_path)
    service.start()
    try:
        go(page, service, "stations")
        for where, said in (("stations", "POST"), ("skus", "make demo"), ("yield", "simulated runs")):
            page.goto(f"{service.url}/#/{where}")
            expect(page.locator(".notice-empty")).to_contain_text(said)
        page.screenshot(path=shots / "yield-none.png")
        page.goto(f"{service.url}/#/skus/nothing")
        expect(page.get_by_role("alert")).to_contain_text("There is no SKU 'nothing'")
    finally:
        service.stop()
