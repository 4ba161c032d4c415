"""A target is printed and shown: its sheet in a browser, and a measured screen that shows it at true size."""

import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from playwright.sync_api import Page, expect

from service.demo.customer import Customer
from service.usecases.sheets import SheetFormat, make_sheet
from tests.browser.access import Access
from tests.browser.chromium import Watch, find_chromium
from tests.browser.pixels import pixels_of
from tests.browser.serving import Serving, prepare_service
from tests.browser.target_screen import assert_true_size, declared, go, measure_by_ruler, show, spacing_of

BOARD = "chessboard:9x6:20mm"
OTHERS = ("charuco:8x5:20mm:15mm:4x4_50", "aprilgrid:5x4:24mm:0.3", "circles:4x7:16mm:10mm")
CARD_MM = 85.6
FORMATS: tuple[SheetFormat, ...] = ("pdf", "svg")


@pytest.fixture(scope="module")
def plant(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    """A service with one board."""
    find_chromium()
    service = prepare_service(tmp_path_factory.mktemp("targets"))
    service.start()
    customer = Customer.of(service.url, service.key)
    with customer.http:
        customer.ask("POST", "/targets", json={"serial": "BOARD-7", "spec": BOARD})
    yield service
    service.stop()


def test_a_measured_screen_shows_the_target_in_its_declared_size(
    page: Page, plant: Serving, watch: Watch, shots: Path
) -> None:
    go(page, plant, f"targets/{BOARD}")
    expect(page.get_by_text("not measured yet")).to_be_visible()
    measure_by_ruler(page, 1.0, 4.008)
    expect(page.get_by_text("This screen has 4.008 pixels per mm.")).to_be_visible()
    page.screenshot(path=shots / "target-measured.png", full_page=True)
    dialog = show(page)

    assert_true_size(dialog, 4.008)
    page.screenshot(path=shots / "target-shown.png")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


@pytest.mark.parametrize("spec", OTHERS)
def test_every_kind_of_target_is_shown_as_its_detector_expects_it(
    page: Page, plant: Serving, shots: Path, spec: str
) -> None:
    go(page, plant, f"targets/{spec}")
    measure_by_ruler(page, 1.0, 5.1)
    dialog = show(page)

    scale, deviation = spacing_of(pixels_of(dialog), declared(dialog))

    page.screenshot(path=shots / f"target-shown-{spec.split(':', maxsplit=1)[0]}.png")
    assert scale == pytest.approx(5.1, rel=5e-4)
    assert deviation < 0.15


def test_a_screen_is_measured_with_a_card_by_keys_or_by_dragging_and_stays_measured(
    page: Page, plant: Serving, watch: Watch, shots: Path
) -> None:
    go(page, plant, f"targets/{BOARD}")
    card, edge = page.locator(".bank-card"), page.get_by_role("slider")
    page.screenshot(path=shots / "target-card.png", full_page=True)
    edge.focus()
    before = int(edge.get_attribute("aria-valuenow") or 0)
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "Shift+ArrowRight", "PageUp"):
        page.keyboard.press(key)
    assert int(edge.get_attribute("aria-valuenow") or 0) == before + 21
    page.get_by_role("button", name="Wider by one pixel").click()
    assert int(edge.get_attribute("aria-valuenow") or 0) == before + 22
    box, handle = card.bounding_box(), edge.bounding_box()
    assert box is not None
    assert handle is not None
    page.mouse.move(handle["x"] + handle["width"] / 2, handle["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 300, box["y"] + 20, steps=5)
    page.mouse.move(box["x"] + 352, box["y"] + 20, steps=5)
    page.mouse.up()
    drawn = card.bounding_box()
    assert drawn is not None
    assert drawn["width"] == pytest.approx(352, abs=1)
    assert drawn["height"] / drawn["width"] == pytest.approx(53.98 / CARD_MM, rel=1e-3)
    page.get_by_role("button", name="Keep for this screen").click()

    known = f"This screen has {round(drawn['width']) / CARD_MM:.3f} pixels per mm."
    expect(page.get_by_text(known)).to_be_visible()
    page.reload()
    go(page, plant, "targets/chessboard:9x6:18mm")
    expect(page.get_by_text(known)).to_be_visible()
    page.get_by_role("button", name="Measure again").click()
    expect(edge).to_have_attribute("aria-valuenow", str(round(drawn["width"])))
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_target_that_does_not_fit_is_said_with_the_size_that_does(
    page: Page, plant: Serving, shots: Path
) -> None:
    go(page, plant, "targets/chessboard:9x6:60mm")
    measure_by_ruler(page, 1.0, 4.0)
    alert = page.get_by_role("alert")
    expect(alert).to_contain_text("it needs 618 mm × 438 mm")
    dialog = show(page)
    expect(dialog.get_by_role("alert")).to_be_visible()
    page.screenshot(path=shots / "target-too-large.png")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)

    alert.get_by_role("link").click()
    expect(page.get_by_role("heading", level=1)).not_to_have_text("chessboard:9x6:60mm")
    expect(page.get_by_role("button", name="Show it on the whole screen")).to_be_visible()
    expect(page.get_by_role("alert")).to_have_count(0)
    page.get_by_role("button", name="With a ruler").or_(
        page.get_by_role("button", name="Measure again")
    ).click()
    page.get_by_role("button", name="With a ruler").click()
    page.get_by_label("Length of the bar").fill("1")
    page.get_by_role("button", name="Keep for this screen").click()
    expect(page.get_by_role("alert")).to_contain_text("No screen is like that")


def test_targets_are_listed_and_their_sheets_downloaded(
    page: Page, plant: Serving, tmp_path: Path, watch: Watch, shots: Path
) -> None:
    go(page, plant, "targets")
    expect(page.get_by_role("row", name="BOARD-7")).to_contain_text(BOARD)
    page.screenshot(path=shots / "targets.png")
    page.get_by_label("Print or show a target").fill("chessboard:11x8:15mm")
    page.get_by_role("button", name="Open").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("chessboard:11x8:15mm")
    for kind in FORMATS:
        with page.expect_download() as waiting:
            page.get_by_role("button", name=f"Download {kind.upper()}").click()
        file = tmp_path / waiting.value.suggested_filename
        waiting.value.save_as(file)
        assert file.name == f"chessboard-11x8-15mm-A4.{kind}"
        assert file.read_bytes() == make_sheet("chessboard:11x8:15mm", kind).content
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])

    page.get_by_label("Paper", exact=True).select_option("own")
    page.get_by_label("Own size of the paper").fill("100x100mm")
    page.get_by_role("button", name="Download PDF").click()
    expect(page.get_by_role("alert")).to_contain_text("larger paper")
    page.screenshot(path=shots / "target-no-paper.png", full_page=True)
    go(page, plant, "targets/nonsense")
    expect(page.get_by_role("alert")).to_contain_text("is not a target")


@pytest.mark.parametrize("spec", [BOARD, *OTHERS])
def test_a_sheet_that_a_browser_draws_holds_the_target_in_true_millimetres(
    page: Page, shots: Path, spec: str
) -> None:
    made = make_sheet(spec, "svg")
    root = ET.fromstring(made.content)  # noqa: S314 - our own file
    assert root.attrib["width"] == f"{made.paper.width_mm:g}mm"
    page.set_viewport_size({"width": 1240, "height": 1240})
    page.set_content(f"<body style='margin:0'>{made.content.decode().split('?>', 1)[1]}</body>")
    page.screenshot(path=shots / f"sheet-{spec.split(':', maxsplit=1)[0]}.png")

    scale, deviation = spacing_of(pixels_of(page.locator("svg")), spec)

    # A CSS inch is 96 pixels.
    assert scale == pytest.approx(96 / 25.4, rel=5e-4)
    assert deviation < 0.15


def test_pages_of_targets_can_be_used_by_everybody_in_every_language(
    page: Page, plant: Serving, watch: Watch, shots: Path
) -> None:
    access = Access()
    go(page, plant, "targets")
    access.look(page, "targets")
    go(page, plant, f"targets/{BOARD}")
    access.look(page, "card")
    page.get_by_role("button", name="With a ruler").click()
    access.look(page, "ruler")
    measure_by_ruler(page, 1.0, 4.0)
    access.look(page, "measured")
    show(page)
    access.look(page, "shown")
    page.get_by_role("button", name="Close").click()
    for language, dark in (("de", "Dunkel"), ("zh", "深色")):
        page.get_by_label(re.compile("Language|Sprache")).select_option(language)
        page.get_by_role("button", name=dark).click()
        for width in (1366, 420):
            page.set_viewport_size({"width": width, "height": 900})
            page.wait_for_timeout(200)
            page.screenshot(path=shots / f"target-{language}-{width}-dark.png", full_page=True)
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
