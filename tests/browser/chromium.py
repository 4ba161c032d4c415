"""A real Chromium with a page that is watched: what it logs, what fails in it, and where it connects."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Page, Request, Response, sync_playwright

FLAGS = (
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
# Without a graphics card there is no WebGL, unless a renderer in software stands in.
WITHOUT_WEBGL = ("--disable-gpu", "--disable-3d-apis")
WEBGL_IN_SOFTWARE = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
HERE = {"127.0.0.1", "localhost"}
LOCAL_SCHEMES = {"blob", "data"}


@dataclass
class Watch:
    """What a page did that its user does not see."""

    errors: list[str] = field(default_factory=list)
    outside: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)

    def follow(self, page: Page) -> None:
        """Note what the page does from now on."""
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", self._see)
        page.on("response", self._read)

    def _hear(self, message: ConsoleMessage) -> None:
        if message.type in {"error", "warning"}:
            self.errors.append(message.text)

    def _see(self, request: Request) -> None:
        address = urlsplit(request.url)
        if address.scheme not in LOCAL_SCHEMES and address.hostname not in HERE:
            self.outside.append(request.url)

    def _read(self, response: Response) -> None:
        if response.status >= 400:
            self.refused.append(f"{response.status} {response.url}")


def find_chromium() -> str:
    """Return the program; skips the test where there is none, but fails in CI."""
    found = next((path for name in PROGRAMS if (path := shutil.which(name))), None)
    if found is None:
        reason = (
            "NO BROWSER TEST WAS RUN: there is no Chromium. Install it (Debian: apt-get install chromium)."
        )
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    return found


@contextmanager
def running_chromium(drawing: tuple[str, ...] = WITHOUT_WEBGL) -> Iterator[Browser]:
    """Run a headless Chromium that asks nobody outside for anything; drawing: flags for or against WebGL."""
    program = find_chromium()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, headless=True, args=[*FLAGS, *drawing])
        yield browser
        browser.close()
