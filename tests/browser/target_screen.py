"""A screen that shows a target: measured as one of a given density, and looked at with the detector."""

import re

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Locator, Page, expect

from service.core.vision.detection import detect_target
from service.core.vision.target import parse_target
from tests.browser.pixels import pixels_of
from tests.browser.serving import Serving


def go(page: Page, plant: Serving, where: str) -> None:
    """Open a page of the dashboard: with the key in the address where it is not known yet."""
    known = page.url.startswith(plant.url)
    page.goto(f"{plant.url}/#/{where}" if known else f"{plant.url}/#key={plant.key}&/{where}")
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    expect(page.locator(".notice-loading")).to_have_count(0)


def grey(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A screenshot as a camera without noise sees it: a little blurred, and not overexposed."""
    one = 0.9 * cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY)
    return np.asarray(cv2.GaussianBlur(one, (0, 0), 0.8), dtype=np.uint8)


def spacing_of(picture: NDArray[np.uint8], spec: str) -> tuple[float, float]:
    """Pixels per mm between the features of a target seen straight on, and the largest deviation, px."""
    target = parse_target(spec)
    found = detect_target(grey(picture), target)
    assert len(found.corner_ids) == len(target.object_points)
    points, wanted = found.image_points, 1000 * target.object_points[found.corner_ids, :2]
    seen, true = points - points.mean(axis=0), wanted - wanted.mean(axis=0)
    scale = float((seen * true).sum() / (true * true).sum())
    return scale, float(np.abs(seen - scale * true).max())


def measure_by_ruler(page: Page, ratio: float, density: float) -> None:
    """Measure the screen as one that has so many device pixels per mm."""
    page.get_by_role("button", name="With a ruler").click()
    box = page.locator(".measured-bar").bounding_box()
    assert box is not None
    page.get_by_label("Length of the bar").fill(f"{box['width'] * ratio / density:.4f}")
    page.get_by_role("button", name="Keep for this screen").click()


def show(page: Page) -> Locator:
    """Show the target on the whole screen."""
    page.get_by_role("button", name="Show it on the whole screen").click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_be_visible()
    page.wait_for_timeout(400)
    return dialog


def declared(dialog: Locator) -> str:
    """The target that the screen says it shows."""
    return dialog.locator(".shown-caption b").inner_text()


def assert_true_size(dialog: Locator, density: float) -> None:
    """Squares of 20 mm are drawn as 80 whole pixels, and declared as that."""
    spec = declared(dialog)
    assert float(re.findall(r":([\d.]+)mm", spec)[0]) == pytest.approx(80 / density, abs=2e-4)
    picture = pixels_of(dialog.get_by_role("img"))
    scale, deviation = spacing_of(picture, spec)
    assert scale == pytest.approx(density, rel=2e-4)
    assert deviation < 0.02
    # Nothing of the pattern is grey; the screenshot may cut the ground in the middle of a pixel.
    assert set(np.unique(picture[4:-4, 4:-4])) == {0, 255}
