"""An engineer reviews pose sets: looks at one from all sides, compares two, publishes and retires."""

import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from service.demo.customer import Customer
from service.demo.skus import PAPER_SKUS
from tests.browser.chromium import WEBGL_IN_SOFTWARE, Watch, find_chromium, running_chromium
from tests.browser.pixels import pixels_of
from tests.browser.serving import Serving, prepare_service

# So that the smallest number of poses lies in the middle of the curve.
SKU = {**PAPER_SKUS[0], "required_mapping_px": 0.11}
SPACE = "boards in front of the camera"


@dataclass(frozen=True)
class Sets:
    """A planned set that tells its curve, published, and a draft of its first six poses."""

    serving: Serving
    customer: Customer
    planned: dict[str, Any]
    few: dict[str, Any]


@pytest.fixture(scope="module")
def sets(built_web: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Sets]:
    """A service of its own with two pose sets."""
    find_chromium()
    serving = prepare_service(tmp_path_factory.mktemp("review"))
    serving.start()
    with ExitStack() as stack:
        stack.callback(serving.stop)
        customer = Customer.of(serving.url, serving.key)
        stack.enter_context(customer.http)
        customer.describe_sku(SKU)
        planned = customer.plan_poses(SKU["code"], lambda _: None)
        poses = [{name: pose[name] for name in ("rvec", "tvec")} for pose in planned["poses"][:6]]
        path = f"/skus/{SKU['code']}/revisions/1/pose-sets"
        few = customer.ask("POST", path, json={"poses": poses})["pose_set"]
        yield Sets(serving, customer, customer.ask("GET", f"/pose-sets/{planned['id']}"), few)


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    """A Chromium that draws in space, in software."""
    with running_chromium(WEBGL_IN_SOFTWARE) as browser:
        yield browser


def go(page: Page, sets: Sets, where: str) -> None:
    """Open a page of the dashboard with the key in the address."""
    page.goto(f"{sets.serving.url}/#key={sets.serving.key}&/{where}")
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    expect(page.get_by_role("status")).to_have_count(0)


def changes(place: Locator, act: Callable[[], object]) -> int:
    """How much the picture of a place changes by an act: pixels that are another colour then."""
    before = pixels_of(place).astype(int)
    act()
    place.page.wait_for_timeout(150)
    return int((np.abs(pixels_of(place).astype(int) - before).max(axis=2) > 40).sum())


def test_a_set_is_seen_from_all_sides(page: Page, sets: Sets, watch: Watch, shots: Path) -> None:
    go(page, sets, f"pose-sets/{sets.planned['id']}")
    space = page.get_by_role("img", name=SPACE)
    expect(space.locator("canvas")).to_be_visible()
    expect(page.get_by_role("region", name="In front of the camera")).to_contain_text(
        "Arrow keys turn", ignore_case=True
    )

    space.scroll_into_view_if_needed()
    assert len(np.unique(pixels_of(space).reshape(-1, 3), axis=0)) > 200
    space.focus()
    assert changes(space, lambda: page.keyboard.press("ArrowRight")) > 2000
    assert changes(space, lambda: page.keyboard.press("+")) > 2000
    box = space.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag() -> None:
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 120, y + 20, steps=4)
        page.mouse.up()

    assert changes(space, drag) > 2000
    for side in ("the camera", "the side", "above"):
        assert changes(space, page.get_by_role("button", name=side, exact=True).click) > 2000
        space.screenshot(path=shots / f"space-{side.replace(' ', '-')}.png")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_pose_is_picked_out_in_image_space_and_list(page: Page, sets: Sets, shots: Path) -> None:
    go(page, sets, f"pose-sets/{sets.planned['id']}")
    space, picture = page.get_by_role("img", name=SPACE), page.locator(".pose-field")
    expect(space.locator("canvas")).to_be_visible()
    button = page.get_by_role("button", name="Pose 12", exact=True)

    def choose() -> None:
        button.focus()
        page.keyboard.press("Enter")
        space.scroll_into_view_if_needed()

    space.scroll_into_view_if_needed()
    assert changes(space, choose) > 300
    expect(button).to_have_attribute("aria-pressed", "true")
    expect(picture.get_by_role("img", name="pose 12 is picked out")).to_be_visible()
    expect(page.get_by_role("img", name="pose 12 is picked out. Arrow keys")).to_be_visible()
    page.get_by_role("button", name="the camera", exact=True).click()
    number = hover_a_board(page, space, sets)
    expect(page.locator(".poses tr.hovered")).to_have_count(1)
    expect(page.locator(".poses tr.hovered th")).to_have_text(str(number))
    page.screenshot(path=shots / "review-hovered.png")
    page.mouse.down()
    page.mouse.up()
    expect(page.get_by_role("button", name=f"Pose {number}", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )


def hover_a_board(page: Page, space: Locator, sets: Sets) -> int:
    """Move the pointer onto a board that none hides, in the view from the camera; return its number."""
    review = sets.customer.ask("GET", f"/pose-sets/{sets.planned['id']}/review")
    corners = np.array([pose["plate_corners_m"] for pose in review["poses"]])
    box = space.bounding_box()
    assert box is not None
    # As far behind the camera as the view stands, which sees 42 degrees of height.
    back = (max(1.0, 1.5 * box["height"] / box["width"]) * 0.9 - 0.55) * corners[..., 2].max()
    focal = box["height"] / 2 / np.tan(np.deg2rad(21))
    seen = focal * corners[..., :2] / (corners[..., 2:] + back)
    for index, board in enumerate(seen):
        others = [other.astype(np.float32) for i, other in enumerate(seen) if i != index]
        for weights in np.random.default_rng(1).dirichlet(np.ones(4), size=200):
            u, v = (float(part) for part in weights @ board)
            inside = cv2.pointPolygonTest(board.astype(np.float32), (u, v), True) > 8
            if inside and all(cv2.pointPolygonTest(other, (u, v), True) < -3 for other in others):
                page.mouse.move(box["x"] + box["width"] / 2 + u, box["y"] + box["height"] / 2 + v)
                return index + 1
    raise AssertionError("every board is hidden by another one")


def test_figures_and_maps_are_the_services(page: Page, sets: Sets, watch: Watch, shots: Path) -> None:
    review = sets.customer.ask("GET", f"/pose-sets/{sets.planned['id']}/review")
    go(page, sets, f"pose-sets/{sets.planned['id']}")

    figures = page.get_by_role("region", name="At a glance")
    expect(figures).to_contain_text(f"{review['working_zone']['mean_px']:.4f} px")
    expect(figures).to_contain_text(f"{sets.planned['prediction']['smallest_count']} would do")
    losses = [pose["loss_share"] for pose in review["poses"]]
    strongest = int(np.argmax(losses)) + 1
    expect(page.get_by_role("region", name="In the image")).to_contain_text(f"most rests on pose {strongest}")
    errors = page.get_by_role("region", name="Predicted mapping error")
    field = errors.locator(".field")
    field.scroll_into_view_if_needed()
    box = field.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2 + 2, box["y"] + box["height"] / 2)
    value = review["maps"]["sd_px"][12][20]
    expect(errors.locator(".heat-read")).to_contain_text(f"{value:.3g}")
    assert changes(field, errors.get_by_role("button", name="mdeg").click) > 300
    expect(errors.locator(".heat-scale")).to_contain_text("mdeg")
    expect(page.get_by_role("region", name="How many poses")).to_be_visible()
    page.get_by_text("Numbers", exact=True).click()
    expect(page.locator(".count-numbers tbody tr")).to_have_count(28)
    page.screenshot(path=shots / "review.png", full_page=True)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_two_sets_are_compared_on_one_scale(page: Page, sets: Sets, watch: Watch, shots: Path) -> None:
    go(page, sets, f"pose-sets/{sets.planned['id']}")
    page.get_by_label("Compare with").select_option(sets.few["id"])

    expect(page.get_by_role("heading", level=1)).to_contain_text("Two pose sets")
    assert page.url.endswith(f"#/pose-sets/{sets.planned['id']}?with={sets.few['id']}")
    rows = page.locator(".compare tbody tr")
    ratio = sets.few["prediction"]["norm_px"] / sets.planned["prediction"]["norm_px"]
    norm = rows.filter(has_text="Norm of the parameters")
    expect(norm).to_contain_text(f"× {ratio:.2f}")
    expect(norm).to_contain_text("worse")
    ends = [
        name.split("…")[1]
        for one in page.get_by_role("region", name="Predicted mapping error")
        .locator(".heat-scale canvas")
        .all()
        if (name := one.get_attribute("aria-label"))
    ]
    assert len(ends) == 2
    assert ends[0] == ends[1]
    expect(page.get_by_role("region", name="How many poses")).to_be_visible()
    page.screenshot(path=shots / "comparison.png", full_page=True)
    page.get_by_role("link", name="End the comparison").click()
    expect(page.get_by_role("heading", level=1)).to_contain_text("Pose set · lens1")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_a_file_goes_out_and_comes_back_and_what_is_refused_is_told(
    page: Page, sets: Sets, tmp_path: Path, shots: Path
) -> None:
    go(page, sets, f"pose-sets/{sets.planned['id']}")
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Download JSON").click()
    file = tmp_path / waiting.value.suggested_filename
    waiting.value.save_as(file)
    document = json.loads(file.read_text())
    assert (document["sku"], len(document["poses"])) == (SKU["code"], len(sets.planned["poses"]))

    page.get_by_role("link", name=f"All of {SKU['code']}").click()
    page.get_by_label("Upload a pose set").set_input_files(file)
    made = page.locator(".upload-done").get_by_role("link", name=file.name)
    expect(made).to_be_visible()
    other = tmp_path / "other.json"
    other.write_text(json.dumps({**document, "sku": "lens2", "image_size": [1920, 1208]}))
    page.get_by_label("Upload a pose set").set_input_files(other)
    alert = page.get_by_role("alert")
    expect(alert).to_contain_text("sku is lens2, here it is lens1; image_size is 1920x1208 px")
    page.screenshot(path=shots / "upload-refused.png", full_page=True)
    other.write_text("no JSON")
    page.get_by_label("Upload a pose set").set_input_files(other)
    expect(alert).to_contain_text("The file is no JSON")
    page.get_by_label("Upload a pose set").set_input_files(file)
    made.click()
    expect(page.locator(".publishing")).to_contain_text("draft")
    expect(page.get_by_role("region", name="Provenance")).to_contain_text("imported")


def test_a_set_is_published_and_retired_after_a_question(page: Page, sets: Sets, shots: Path) -> None:
    go(page, sets, f"pose-sets/{sets.few['id']}")
    state = page.locator(".publishing")
    # Nobody told what sets of other sizes promise.
    expect(page.get_by_role("region", name="How many poses")).to_have_count(0)
    page.get_by_role("button", name="Publish", exact=True).click()
    question = page.get_by_role("dialog", name="Publish this pose set?")
    expect(question).to_contain_text("New runs of lens1, rev. 1")
    page.screenshot(path=shots / "publish-question.png")
    question.get_by_role("button", name="Leave it as it is").click()
    expect(state).to_contain_text("draft")

    page.get_by_role("button", name="Publish", exact=True).click()
    question.get_by_role("button", name="Publish", exact=True).click()

    expect(state).to_contain_text("by browser test")
    before = sets.customer.ask("GET", f"/pose-sets/{sets.planned['id']}")
    assert (before["state"], before["retired_by"]) == ("retired", "browser test")
    page.get_by_role("button", name="Retire", exact=True).click()
    page.get_by_role("dialog").get_by_role("button", name="Retire", exact=True).click()
    expect(state).to_contain_text("retired")
    expect(page.get_by_role("button", name="Retire", exact=True)).to_have_count(0)
    assert sets.customer.ask("GET", f"/pose-sets/{sets.few['id']}")["state"] == "retired"
    page.screenshot(path=shots / "retired.png")


@pytest.mark.parametrize("where", ["one", "two"])
def test_the_page_holds_in_german_in_the_dark_and_at_any_width(
    page: Page, sets: Sets, watch: Watch, shots: Path, where: str
) -> None:
    page.set_viewport_size({"width": 1366, "height": 900})
    query = f"?with={sets.few['id']}" if where == "two" else ""
    go(page, sets, f"pose-sets/{sets.planned['id']}{query}")
    page.get_by_label("Language").select_option("de")
    page.get_by_role("button", name="Dunkel").click()
    expect(page.get_by_role("region", name="Vorhergesagter Abbildungsfehler")).to_be_visible()
    for width in (1366, 420):
        page.set_viewport_size({"width": width, "height": 900})
        page.wait_for_timeout(300)
        page.screenshot(path=shots / f"review-{where}-{width}-german-dark.png", full_page=True)
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
