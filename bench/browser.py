"""Frame grabbed to overlay drawn in a real browser: the real kiosk page, its own camera, a local service.

Chromium takes a film of rendered boards for a camera of 1280x800 at 30 frames a second. A frame is grabbed
when the page's worker has its pixels, and drawn at the animation frame that follows the page's drawing.
Needs Chromium and the built pages (`make setup`). Not here: many kiosks at one process (`kiosks`).
"""

import shutil
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from playwright.sync_api import Page, sync_playwright

from bench.detection import SPACE
from bench.kiosks import prepare_stations
from service.core.planning.pose_space import sample_poses
from service.core.vision.target import parse_target
from service.demo.customer import Customer
from service.demo.server import running_service
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import nominal_camera
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene

SEED = 4
PICTURES = 16
FRAMES_PER_S = 30
QUICK_S, FULL_S, SETTLE_S = 6.0, 30.0, 3.0
CLOCK = Path(__file__).with_name("browser_clock.js")
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = (
    "--no-sandbox",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-gpu",
    "--use-fake-device-for-media-stream",
    "--use-fake-ui-for-media-stream",
)


class NoBrowser(Exception):
    """There is no Chromium to measure with."""


def run(quick: bool) -> dict[str, Any]:
    """Return `p50_ms`, `p95_ms` of grabbed to drawn, and `frames_per_s`."""
    sku = PAPER_SKUS[0]
    with TemporaryDirectory() as directory:
        film = write_film(sku, Path(directory) / "camera.y4m")
        data_dir = Path(directory) / "data"
        data_dir.mkdir()
        with running_service(data_dir, 0) as service:
            station = prepare_stations(Customer.of(service.url, service.key), sku)[0]
            address = f"{service.url}/kiosk?station={station}#key={service.key}"
            drawn = _watch(film, address, QUICK_S if quick else FULL_S)
    return {**summarise(drawn), "image_size": sku["image_size"], "seeds": [SEED]}


def table(result: Mapping[str, Any]) -> str:
    """Return the result as text."""
    return (
        f"grabbed to drawn: p50 {result['p50_ms']:.0f} ms, p95 {result['p95_ms']:.0f} ms, max "
        f"{result['max_ms']:.0f} ms at {result['frames_per_s']:.1f} frames/s; board present in "
        f"{result['present']:.2f} of {result['frames']} frames"
    )


def summarise(drawn: list[tuple[float, float, str]]) -> dict[str, Any]:
    """Return the figures of frames drawn: when, ms, how long after they were grabbed, ms, what they show."""
    at_ms = np.array([one[0] for one in drawn])
    age_ms = np.array([one[1] for one in drawn])
    p50, p95 = np.percentile(age_ms, (50, 95))
    return {
        "p50_ms": float(p50),
        "p95_ms": float(p95),
        "max_ms": float(age_ms.max()),
        "frames_per_s": 1e3 * (len(drawn) - 1) / float(at_ms[-1] - at_ms[0]),
        "present": float(np.mean([board == "present" for _, _, board in drawn])),
        "frames": len(drawn),
    }


def write_film(sku: Mapping[str, Any], file: Path) -> Path:
    """Write rendered boards as a film that Chromium takes for a camera and repeats."""
    camera, target = nominal_camera(sku), parse_target(sku["target"])
    prepared, rng = prepare(production_scene(camera, target, SEED)), np.random.default_rng(SEED)
    poses = sample_poses(SPACE, camera, target, PICTURES, SEED)
    width, height = camera.image_size
    colour = np.full(width * height // 2, 128, np.uint8).tobytes()
    with file.open("wb") as film:
        film.write(f"YUV4MPEG2 W{width} H{height} F{FRAMES_PER_S}:1 Ip A1:1 C420jpeg\n".encode())
        for i in range(PICTURES):
            film.write(b"FRAME\n" + prepared.render(poses.pose(i), rng).tobytes() + colour)
    return file


def _watch(film: Path, address: str, seconds: float) -> list[tuple[float, float, str]]:
    program = next((path for name in PROGRAMS if (path := shutil.which(name))), None)
    if program is None:
        raise NoBrowser("There is no Chromium; install it (Debian: apt-get install chromium).")
    flags = [*FLAGS, f"--use-file-for-fake-video-capture={film}"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, headless=True, args=flags)
        context = browser.new_context(
            viewport={"width": 1600, "height": 1000}, locale="en-GB", permissions=["camera"]
        )
        page = context.new_page()
        page.add_init_script(path=CLOCK)
        page.goto(address)
        _open_run(page)
        page.wait_for_function("() => window.benchSeen.drawn.length > 0", timeout=60_000)
        page.wait_for_timeout(1e3 * SETTLE_S)
        page.evaluate("() => { window.benchSeen.drawn.length = 0; }")
        page.wait_for_timeout(1e3 * seconds)
        drawn = page.evaluate("() => window.benchSeen.drawn")
        browser.close()
    return [(float(at), float(age), str(board)) for at, age, board in drawn]


def _open_run(page: Page) -> None:
    """Give a serial as a scanner does; the only SKU that there is is chosen already."""
    page.get_by_label("Serial", exact=True).wait_for()
    page.keyboard.type("BENCH-1")
    page.keyboard.press("Enter")
