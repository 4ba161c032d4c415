"""Stations for kiosk tests: real service, simulated hands, small cameras; and what a person does there."""

from collections.abc import Callable, Mapping
from typing import Any

from playwright.sync_api import Locator, Page, expect

from service.demo.customer import Customer
from tests.browser.serving import Serving
from tests.plant import SKU, poses_json

# The hand may live faster than real time: a test waits for the page, not for the hand.
SPEED = 4.0
POSES = len(poses_json())
# Nobody determines a focal length so well: every run ends with FAIL.
IMPOSSIBLE = {
    **SKU,
    "code": "strict",
    "limits": {**SKU["limits"], "focal_sd_share": 1e-9},
    # More poses would not help either.
    "extra_poses": 0,
}
# Its run is aborted in the middle: with so many poses it is not over before, however slow the browser is.
LONG = {**SKU, "code": "long", "pose_count": 30}
A_RUN_MS = 150_000

RunJson = dict[str, Any]


def prepare_stations(serving: Serving, poses: int = POSES, limits: Mapping[str, float] | None = None) -> None:
    """Publish a camera that passes, one that fails and one that takes long, and register stations for all.

    limits: besides those of the cameras, for runs of so few poses that the usual ones would not pass.
    """
    customer = Customer.of(serving.url, serving.key)
    with customer.http:
        some, many = poses_json()[:poses], poses_json(LONG["pose_count"])
        for sku, asked_for in ((SKU, some), (IMPOSSIBLE, some), (LONG, many)):
            customer.describe_sku({**sku, "limits": {**(limits or {}), **sku["limits"]}})
            asked = customer.ask(
                "POST", f"/skus/{sku['code']}/revisions/1/pose-sets", json={"poses": asked_for}
            )
            customer.ask("POST", f"/pose-sets/{asked['pose_set']['id']}/publish")
        for code, source in (("line1", "virtual"), ("line2", "virtual"), ("own", "browser")):
            customer.ask(
                "POST", "/stations", json={"code": code, "name": f"Station {code}", "source": source}
            )


def stored_run(serving: Serving, serial: str) -> RunJson:
    """The newest run of a serial, as the service has it stored."""
    customer = Customer.of(serving.url, serving.key)
    with customer.http:
        return dict(customer.ask("GET", f"/vehicles/{serial}")["runs"][0])


def open_kiosk(page: Page, serving: Serving, station: str = "line1") -> None:
    """Open a station's kiosk and wait until it asks for a serial."""
    page.goto(f"{serving.url}/kiosk?station={station}#key={serving.key}")
    expect(page.get_by_label("Serial", exact=True)).to_be_focused()


def scan(page: Page, serial: str, sku: str = "tiny") -> None:
    """Choose the camera and give the serial as a scanner does: letters, then Enter."""
    page.get_by_role("button", name=sku, exact=True).click()
    expect(page.get_by_label("Serial", exact=True)).to_be_focused()
    page.keyboard.type(serial)
    page.keyboard.press("Enter")
    expect(page.locator(".whose-serial")).to_have_text(serial)


def taken(page: Page) -> int:
    """How many poses the page shows as taken."""
    return page.locator(".tile-taken").count()


def wait_for_captures(page: Page, count: int) -> None:
    """Wait until so many poses are taken."""
    page.wait_for_function(
        "n => document.querySelectorAll('.tile-taken').length >= n", arg=count, timeout=A_RUN_MS
    )


def verdict_of(page: Page) -> Locator:
    """The verdict's screen, once it is there."""
    screen = page.locator("[data-verdict]")
    expect(screen).to_be_visible(timeout=A_RUN_MS)
    return screen


def wait_for_hint(page: Page, fits: Callable[[str], bool]) -> str:
    """Wait for an instruction that fits, and return its code as the display shows it."""
    for _ in range(2000):
        code = page.evaluate("document.querySelector('.strip')?.dataset.hint ?? ''")
        if fits(str(code)):
            return str(code)
        page.wait_for_timeout(40)
    raise AssertionError("no such instruction came")


def scan_label(page: Page, serial: str) -> None:
    """Read a label as a scanner does: all letters at once, however slowly a busy page answers the test."""
    page.evaluate(
        """serial => {
            for (const key of [...serial, 'Enter'])
                (document.activeElement ?? document.body).dispatchEvent(
                    new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
        }""",
        serial,
    )


def press_while_moving(page: Page, key: str) -> None:
    """Press a key in the very moment in which the page asks for a movement; soon the hand is there."""
    page.wait_for_function(
        """key => {
            if (!document.querySelector('.strip')?.dataset.hint?.startsWith('move')) return false;
            (document.activeElement ?? document.body).dispatchEvent(
                new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
            return true;
        }""",
        arg=key,
    )
