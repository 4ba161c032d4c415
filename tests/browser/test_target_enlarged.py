"""A target on a screen that the system enlarges by a broken number: device pixels count."""

from contextlib import ExitStack
from pathlib import Path

import pytest
from playwright.sync_api import ViewportSize, expect

from tests.browser.chromium import WITHOUT_WEBGL, find_chromium, running_chromium
from tests.browser.serving import prepare_service
from tests.browser.target_screen import assert_true_size, go, measure_by_ruler, show

RATIO = 1.25
SIZE: ViewportSize = {"width": 1600, "height": 1000}


@pytest.mark.parametrize("is_real", [True, False], ids=["enlarged", "emulated"])
def test_a_target_is_drawn_in_device_pixels(
    built_web: Path, tmp_path: Path, shots: Path, is_real: bool
) -> None:
    find_chromium()
    plant = prepare_service(tmp_path)
    plant.start()
    flags = (f"--force-device-scale-factor={RATIO}", "--window-size=1600,1000") if is_real else ()
    with ExitStack() as stack:
        stack.callback(plant.stop)
        chromium = stack.enter_context(running_chromium((*WITHOUT_WEBGL, *flags)))
        if is_real:
            context = chromium.new_context(locale="en-GB", no_viewport=True)
        else:
            context = chromium.new_context(locale="en-GB", viewport=SIZE, device_scale_factor=RATIO)
        page = context.new_page()
        go(page, plant, "targets/chessboard:9x6:20mm")
        expect(page.get_by_text("Device pixel ratio 1.25", exact=True)).to_be_visible()
        expect(page.get_by_text("by a broken number")).to_be_visible()
        measure_by_ruler(page, RATIO, 4.008)
        dialog = show(page)
        page.screenshot(path=shots / f"target-{'enlarged' if is_real else 'emulated'}.png")
        assert_true_size(dialog, 4.008)
