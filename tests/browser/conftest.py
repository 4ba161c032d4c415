"""Fixtures: the built pages, the running service with its runs, and a watched page of a real Chromium."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from service.demo.customer import Customer
from tests.browser.access import Access
from tests.browser.calibrated import Runs, make_runs
from tests.browser.chromium import Watch, find_chromium, running_chromium
from tests.browser.serving import Serving, prepare_service

WEB = Path(__file__).resolve().parents[2] / "web"
# The browser draws in software, and shares two cores with the service and other tests.
PATIENCE_MS = 15_000


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark every test of this folder: each drives a browser, and each takes longer than others may."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)
            item.add_marker(pytest.mark.timeout(300))


@pytest.fixture(scope="session", autouse=True)
def _patience() -> None:
    """Wait longer for what a page is to show."""
    expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="session")
def built_web() -> Path:
    """The built pages; built now where they are missing."""
    if not (WEB / "dist" / "dashboard.html").is_file():
        npm = shutil.which("npm")
        if npm is None:
            pytest.fail("web/dist is missing and there is no npm to build it: run `make setup`.")
        environment = {**os.environ, "CI": "1"}
        for command in (["ci"], ["run", "build"]):
            subprocess.run([npm, *command], cwd=WEB, env=environment, check=True)  # noqa: S603 - our own build
    return WEB / "dist"


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    """A real Chromium for one file: Playwright keeps a loop running, which other tests cannot stand."""
    with running_chromium() as browser:
        yield browser


@pytest.fixture(scope="session")
def serving(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """The real service on SQLite, on a free port."""
    # Before minutes go into calibrations that no browser would show.
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("served"))
    service.start()
    yield service
    service.stop()


@pytest.fixture(scope="session")
def runs(serving: Serving) -> Runs:
    """Three runs: passed, failed, open."""
    customer = Customer.of(serving.url, serving.key)
    with customer.http:
        return make_runs(customer)


@pytest.fixture
def watch() -> Watch:
    """What the page does behind its user's back."""
    return Watch()


@pytest.fixture
def access() -> Access:
    """What axe finds on the pages that it is shown."""
    return Access()


@pytest.fixture
def page(chromium: Browser, watch: Watch) -> Iterator[Page]:
    """A page in a fresh profile: English, light, as wide as a desk screen."""
    context = chromium.new_context(
        viewport={"width": 1600, "height": 1000},
        locale="en-GB",
        color_scheme="light",
        reduced_motion="reduce",
    )
    opened = context.new_page()
    opened.set_default_timeout(20_000)
    watch.follow(opened)
    yield opened
    context.close()


@pytest.fixture(scope="session")
def shots(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where screenshots go; DMSCAL_SHOTS keeps them in a folder of choice."""
    kept = os.environ.get("DMSCAL_SHOTS")
    if kept is None:
        return tmp_path_factory.mktemp("shots")
    Path(kept).mkdir(parents=True, exist_ok=True)
    return Path(kept)
