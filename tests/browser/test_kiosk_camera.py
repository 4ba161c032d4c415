"""The kiosk's own camera: raw grey frames of a real `getUserMedia` in a real browser, fed from a file."""

from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
from playwright.sync_api import Page, expect, sync_playwright

from tests.browser.chromium import FLAGS, Watch, find_chromium
from tests.browser.kiosk_station import open_kiosk, prepare_stations, scan, wait_for_captures
from tests.browser.serving import Serving, prepare_service
from tests.plant import picture

STATION = "own"


@pytest.fixture(scope="module")
def stations(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service with a station whose kiosk brings the camera."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("stations"))
    service.start()
    prepare_stations(service)
    yield service
    service.stop()


def film_of(image: np.ndarray, file: Path) -> Path:
    """Write one grey picture as an endless film that Chromium takes for a camera."""
    height, width = image.shape
    colour = np.full((height // 2, width // 2), 128, np.uint8).tobytes()
    frame = b"FRAME\n" + image.tobytes() + colour + colour
    file.write_bytes(f"YUV4MPEG2 W{width} H{height} F15:1 Ip A1:1 C420jpeg\n".encode() + 8 * frame)
    return file


def grey(index: int) -> np.ndarray:
    """The picture of a pose of the small camera."""
    decoded = cv2.imdecode(np.frombuffer(picture(index), np.uint8), cv2.IMREAD_GRAYSCALE)
    assert decoded is not None
    return np.asarray(decoded)


@pytest.fixture
def page_with(tmp_path: Path, watch: Watch, request: pytest.FixtureRequest) -> Iterator[Page]:
    """A page whose camera shows the picture that the test's parameter gives."""
    film = film_of(request.param(), tmp_path / "camera.y4m")
    flags = (
        *FLAGS,
        "--use-fake-device-for-media-stream",
        "--use-fake-ui-for-media-stream",
        f"--use-file-for-fake-video-capture={film}",
    )
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_chromium(), headless=True, args=flags)
        context = browser.new_context(
            viewport={"width": 1600, "height": 1000}, locale="en-GB", permissions=["camera"]
        )
        page = context.new_page()
        watch.follow(page)
        yield page
        browser.close()


@pytest.mark.parametrize("page_with", [lambda: grey(0)], indirect=True)
def test_a_board_held_in_its_place_is_captured_from_the_raw_frame(
    page_with: Page, stations: Serving, watch: Watch, shots: Path
) -> None:
    open_kiosk(page_with, stations, STATION)
    scan(page_with, "VIN-CAMERA-1")

    wait_for_captures(page_with, 1)
    expect(page_with.locator("[aria-current=step]")).to_have_attribute("aria-label", "Pose 2, asked for now")
    page_with.screenshot(path=shots / "kiosk-camera.png")
    page_with.get_by_role("button", name="Abort").click()
    page_with.get_by_role("button", name="Abort the run").click()
    expect(page_with.get_by_label("Serial", exact=True)).to_be_visible()
    assert watch.errors == []


@pytest.mark.parametrize("page_with", [lambda: np.full((480, 640), 90, np.uint8)], indirect=True)
def test_a_camera_of_another_size_is_said_with_what_to_do(
    page_with: Page, stations: Serving, shots: Path
) -> None:
    open_kiosk(page_with, stations, STATION)
    scan(page_with, "VIN-CAMERA-2")

    expect(page_with.locator("[data-problem]")).to_contain_text("pictures of another size", timeout=20_000)
    page_with.screenshot(path=shots / "kiosk-wrong-size.png")
    page_with.get_by_role("button", name="Abort").click()
    page_with.get_by_role("button", name="Abort the run").click()
    expect(page_with.get_by_label("Serial", exact=True)).to_be_visible()
