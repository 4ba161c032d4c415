"""A station's board as a quality engineer sees it: learnt, certified, drifting, retired."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from service.app import open_database
from tests.browser.access import Access
from tests.browser.chromium import Watch
from tests.browser.own_service import OwnService, own_service
from tests.browser.pixels import pixels_of
from tests.plant import SKU, poses_json, revision
from tests.usecases.test_board_shapes import add_run, bowed

BOARD = "BOARD-1"


@dataclass(frozen=True)
class Line(OwnService):
    """A service whose station has a board that is bowed by 0.8 mm, with six runs that teach its shape."""

    def add_runs(self, bow_mm: float, seeds: range) -> None:
        """Add runs at a board that is bowed by so much."""
        database = open_database(self.serving.settings)
        with database.write() as session:
            for seed in seeds:
                add_run(session, f"VIN-{seed}", bowed(bow_mm), seed)
        database.close()


@pytest.fixture
def line(built_web: Path, tmp_path: Path) -> Iterator[Line]:
    """A line of its own for each test: a certificate is for good."""
    with own_service(tmp_path) as own:
        customer = own.customer
        customer.describe_sku(SKU)
        customer.ask("POST", "/skus/tiny/revisions/1/pose-sets", json={"poses": poses_json()})
        board = {"serial": BOARD, "spec": revision().target.spec}
        target = customer.ask("POST", "/targets", json=board)
        station = {"code": "cal1", "name": "Station 1", "target_id": target["id"]}
        customer.ask("POST", "/stations", json=station)
        made = Line(own.serving, customer)
        made.add_runs(0.8, range(6))
        yield made


def learn(page: Page, version: int) -> None:
    """Have the shape learnt on the page, and wait until it is in the list."""
    page.get_by_label("From how many runs").fill("6")
    page.get_by_role("button", name="Learn", exact=True).click()
    expect(page.get_by_role("link", name=f"Shape {version}", exact=True)).to_be_visible(timeout=60_000)


def press(page: Page, action: str, question: str) -> None:
    """Press a button and say yes to its question."""
    page.get_by_role("button", name=action, exact=True).click()
    page.get_by_role("dialog", name=question).get_by_role("button", name=action, exact=True).click()


def test_a_shape_is_learnt_and_certified(
    page: Page, line: Line, watch: Watch, shots: Path, access: Access
) -> None:
    page.goto(f"{line.serving.url}/#key={line.serving.key}&/stations")
    card = page.get_by_role("listitem")
    expect(card).to_contain_text("taken for flat")
    card.get_by_role("link", name=f"Shape of the board {BOARD}").click()
    expect(page.get_by_role("heading", level=1)).to_have_text(f"Board {BOARD}")
    expect(page.get_by_text("No shape has been learnt yet")).to_be_visible()
    access.look(page, "board without a shape")
    learn(page, 1)

    shape = page.get_by_role("region", name="Shape 1")
    expect(shape).to_contain_text("learnt")
    expect(shape.get_by_role("img", name="Height over the board")).to_be_visible()
    shown = line.customer.ask("GET", f"/targets/{BOARD}/shapes")["items"][0]
    expect(shape).to_contain_text(f"{shown['bend_mm']:.3f} mm")
    page.get_by_role("button", name="Certify", exact=True).click()
    page.screenshot(path=shots / "board-certify.png")
    page.get_by_role("button", name="Leave it as it is").click()
    assert line.customer.ask("GET", f"/targets/{BOARD}")["certified_shape"] is None
    press(page, "Certify", "Certify this shape?")

    expect(page.get_by_text("use its shape 1, certified")).to_be_visible()
    assert line.customer.ask("GET", f"/targets/{BOARD}")["certified_shape"]["certified_by"] == "browser test"
    press(page, "Retire", "Retire this shape?")
    expect(page.get_by_text("Solves take this board for flat")).to_be_visible()
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_drift_is_told_until_the_new_shape_is_certified(
    page: Page, line: Line, watch: Watch, shots: Path, access: Access
) -> None:
    page.goto(f"{line.serving.url}/#key={line.serving.key}&/boards/{BOARD}")
    learn(page, 1)
    press(page, "Certify", "Certify this shape?")
    expect(page.get_by_text("use its shape 1, certified")).to_be_visible()
    line.add_runs(1.1, range(100, 106))
    learn(page, 2)

    expect(page.get_by_text("The board has moved by")).to_be_visible()
    expect(page.get_by_role("img", name="Farthest move of a corner over 1 learnt shapes")).to_be_visible()
    expect(page.get_by_role("row", name="Shape 2")).to_contain_text("over the limit")
    page.screenshot(path=shots / "board-drifted.png", full_page=True)
    access.look(page, "board that has drifted")
    page.get_by_role("link", name="Shape 2", exact=True).click()
    press(page, "Certify", "Certify this shape?")

    expect(page.get_by_role("row", name="Shape 1")).to_contain_text("retired")
    expect(page.get_by_text("The board has moved by")).to_have_count(0)
    page.goto(f"{line.serving.url}/#/stations")
    expect(page.get_by_role("listitem")).to_contain_text("shape 2, certified")
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_the_picture_tells_the_height_of_the_corner_under_the_pointer(page: Page, line: Line) -> None:
    page.goto(f"{line.serving.url}/#key={line.serving.key}&/boards/{BOARD}")
    learn(page, 1)
    shape_id = line.customer.ask("GET", f"/targets/{BOARD}/shapes")["items"][0]["id"]
    detail = line.customer.ask("GET", f"/board-shapes/{shape_id}")
    z = np.array(detail["deviations_mm"])[:, 2]
    columns = len({x for x, _ in detail["corners_mm"]})
    rows = len(z) // columns
    field = page.get_by_role("region", name="Shape 1").locator(".field")
    field.scroll_into_view_if_needed()
    box = field.bounding_box()
    assert box is not None

    for corner in (0, columns // 2, len(z) - 1):
        row, column = divmod(corner, columns)
        page.mouse.move(
            box["x"] + (column + 0.5) / columns * box["width"], box["y"] + (row + 0.5) / rows * box["height"]
        )
        expect(page.locator(".heat-read")).to_contain_text(
            f"corner {corner}: {1000 * (z.max() - z[corner]):.0f} ±"
        )
    # A bow: the middle column and both ends differ by colour.
    pixels = pixels_of(field).astype(int)
    middle, end = pixels[len(pixels) // 2, pixels.shape[1] // 2], pixels[len(pixels) // 2, 4]
    assert np.abs(middle - end).max() > 60


def test_only_engineers_are_offered_to_change_a_board(page: Page, line: Line, watch: Watch) -> None:
    page.goto(f"{line.serving.url}/#key={line.serving.key}&/boards/{BOARD}")
    learn(page, 1)
    viewer = line.key_of("viewer")

    page.get_by_role("button", name="Forget key").click()
    page.get_by_label("Key", exact=True).fill(viewer)
    page.get_by_role("button", name="Open").click()

    expect(page.get_by_role("region", name="Shape 1")).to_contain_text("Bend, peak to peak")
    for name in ("Certify", "Retire", "Learn"):
        expect(page.get_by_role("button", name=name, exact=True)).to_have_count(0)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_what_the_service_refuses_is_told_on_the_page(page: Page, line: Line, shots: Path) -> None:
    bare = line.customer.ask("POST", "/targets", json={"serial": "NEW", "spec": revision().target.spec})
    page.goto(f"{line.serving.url}/#key={line.serving.key}&/boards/{bare['id']}")
    page.get_by_role("button", name="Learn", exact=True).click()

    expect(page.get_by_role("alert")).to_contain_text("at least 5 are needed")
    page.screenshot(path=shots / "board-refused.png")
    page.goto(f"{line.serving.url}/#/boards/nothing")
    expect(page.get_by_role("alert")).to_contain_text("There is no board 'nothing'")


@pytest.mark.parametrize(("language", "theme"), [("de", "Dunkel"), ("zh", "深色")])
def test_the_page_of_a_board_holds_in_other_languages_in_the_dark_and_on_a_narrow_screen(
    page: Page, line: Line, watch: Watch, shots: Path, language: str, theme: str
) -> None:
    page.goto(f"{line.serving.url}/#key={line.serving.key}&/boards/{BOARD}")
    learn(page, 1)
    shape = line.customer.ask("GET", f"/targets/{BOARD}/shapes")["items"][0]
    line.customer.ask("POST", f"/board-shapes/{shape['id']}/certify")
    line.add_runs(0.89, range(200, 206))
    learn(page, 2)
    page.get_by_label("Language").select_option(language)
    page.get_by_role("button", name=theme).click()
    page.screenshot(path=shots / f"board-{language}-dark.png", full_page=True)
    page.set_viewport_size({"width": 420, "height": 900})
    page.wait_for_timeout(300)
    page.screenshot(path=shots / f"board-{language}-narrow.png", full_page=True)

    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
