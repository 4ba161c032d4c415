"""A camera on the network, from the dashboard's card of its station to the picture at the kiosk."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.chromium import Watch, find_chromium
from tests.browser.kiosk_station import open_kiosk, prepare_stations, scan
from tests.browser.serving import Serving, prepare_service
from tests.streams import CameraServer, MjpegHandler, Stage, camera_on, port_of


@pytest.fixture(scope="module")
def stations(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service with stations."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("sources"))
    service.start()
    prepare_stations(service)
    yield service
    service.stop()


@pytest.fixture(scope="module")
def camera() -> Iterator[CameraServer]:
    with camera_on(MjpegHandler, Stage()) as on:
        yield on


def test_a_station_gets_a_camera_by_its_address_and_shows_its_picture(
    page: Page, stations: Serving, camera: CameraServer, watch: Watch, shots: Path
) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    page.goto(f"{stations.url}/#key={stations.key}&/stations")
    card = page.get_by_role("listitem").filter(has_text="Station own")
    card.get_by_role("button", name="Change").click()
    field = card.get_by_label("Source of own")
    field.fill("ftp://camera")
    card.get_by_role("button", name="Save").click()
    expect(card.get_by_role("alert")).to_contain_text("This is no source of frames")
    page.screenshot(path=shots / "station-source-refused.png")
    field.fill(f"http://joe:s3cret@127.0.0.1:{port_of(camera)}/locked")
    card.get_by_role("button", name="Save").click()
    expect(card).to_contain_text(f"http://***@127.0.0.1:{port_of(camera)}/locked")
    page.screenshot(path=shots / "station-source.png")
    refused = list(watch.refused)

    open_kiosk(page, stations, "own")
    expect(page.locator(".start-station")).to_contain_text("MJPEG camera")
    scan(page, "VIN-NET-0001")
    page.keyboard.press("F2")
    figures = page.get_by_label("Figures")
    expect(figures).to_contain_text(re.compile(r"Camera sends\s*[1-9][\d.]* / s"))
    expect(figures).to_contain_text(re.compile(r"Round trip\s*\d+ ms"))
    page.screenshot(path=shots / "kiosk-figures.png")
    assert [line[:3] for line in refused] == ["422"]
    assert watch.outside == []


def test_a_camera_that_stalls_is_said_at_the_kiosk_until_it_is_back(
    page: Page, stations: Serving, camera: CameraServer, shots: Path
) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    page.goto(f"{stations.url}/kiosk?station=own#key={stations.key}")
    expect(page.locator(".count")).to_be_visible()
    page.keyboard.press("F2")
    camera.stage.stalls = True
    problem = page.locator("[data-problem]")
    expect(problem).to_have_attribute("data-problem", "source-stalled")
    page.screenshot(path=shots / "kiosk-stalled.png")
    camera.stage.stalls = False
    expect(problem).to_have_count(0)
