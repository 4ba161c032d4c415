"""The fixture of a station on its card: set, changed, refused at its field, removed."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.api.rest.test_extrinsics import FIXTURE
from tests.browser.access import Access
from tests.browser.chromium import Watch
from tests.browser.own_service import OwnService, own_service

AXES = ("x", "y", "z")


class Stations:
    """A service with one station without a fixture and one with one."""

    def __init__(self, own: OwnService) -> None:
        self.serving, self.customer, self.key_of = own.serving, own.customer, own.key_of
        for code, fixture in (("bare", None), ("fixed", FIXTURE)):
            body = {"code": code, "name": f"Station {code}", "fixture": fixture}
            own.customer.ask("POST", "/stations", json=body)

    def fixture(self, code: str) -> dict[str, Any] | None:
        """What the service has stored."""
        found = self.customer.ask("GET", "/stations")["items"]
        stored: dict[str, Any] | None = next(one["fixture"] for one in found if one["code"] == code)
        return stored


@pytest.fixture
def stations(built_web: Path, tmp_path: Path) -> Iterator[Stations]:
    """A service of its own."""
    with own_service(tmp_path) as own:
        yield Stations(own)


def card_of(page: Page, stations: Stations, code: str, key: str | None = None) -> Locator:
    """The card of a station, on its page."""
    page.goto(f"{stations.serving.url}/#key={key or stations.serving.key}&/stations")
    card = page.get_by_role("listitem").filter(has_text=f"Station {code}")
    expect(card).to_be_visible()
    return card


def fill(card: Locator, position: tuple[float, ...], rotation: tuple[float, ...]) -> None:
    """Type a pose into the form, mm and degrees."""
    for axis, length, angle in zip(AXES, position, rotation, strict=True):
        card.get_by_label(f"Position {axis}, mm").fill(str(length))
        card.get_by_label(f"Rotation {axis}, °").fill(str(angle))


def test_a_fixture_is_set_in_millimetres_and_degrees(
    page: Page, stations: Stations, watch: Watch, shots: Path, access: Access
) -> None:
    card = card_of(page, stations, "bare")
    card.get_by_role("button", name="Set: Fixture of bare").click()
    card.get_by_label("Pattern").fill("chessboard:7x5:30mm")
    fill(card, (1500, 200.5, -1000), (90, 0, -45))
    card.get_by_label("Position ±, mm").fill("0.2")
    card.get_by_label("Rotation ±, mdeg").fill("20")
    access.look(page, "form of a fixture")
    page.screenshot(path=shots / "fixture-form.png", full_page=True)
    card.get_by_role("button", name="Save").click()

    expect(card).to_contain_text("at (1500 / 200.5 / −1000) mm")
    stored = stations.fixture("bare")
    assert stored is not None
    assert stored["pose"]["tvec"] == pytest.approx([1.5, 0.2005, -1.0])
    assert stored["pose"]["rvec"] == pytest.approx([1.5707963, 0.0, -0.7853982])
    assert (stored["translation_sd_mm"], stored["rotation_sd_mdeg"]) == (0.2, 20.0)
    access.look(page, "card with a fixture")
    page.screenshot(path=shots / "fixture-card.png", full_page=True)
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_what_was_not_typed_anew_stays_to_the_last_digit(page: Page, stations: Stations) -> None:
    card = card_of(page, stations, "fixed")
    card.get_by_role("button", name="Change: Fixture of fixed").click()
    expect(card.get_by_label("Position x, mm")).to_have_value("1500")
    card.get_by_label("Position ±, mm").fill("0.5")
    card.get_by_role("button", name="Save").click()

    expect(card).to_contain_text("± 0.5 mm")
    assert stations.fixture("fixed") == {**FIXTURE, "translation_sd_mm": 0.5}


def test_what_the_service_refuses_is_told_at_its_field(
    page: Page, stations: Stations, watch: Watch, shots: Path, access: Access
) -> None:
    card = card_of(page, stations, "fixed")
    card.get_by_role("button", name="Change: Fixture of fixed").click()
    pattern, position = card.get_by_label("Pattern"), card.get_by_label("Position y, mm")
    pattern.fill("cheesboard:7x5:30mm")
    position.fill("1e9")
    card.get_by_role("button", name="Save").click()

    expect(pattern).to_have_attribute("aria-invalid", "true")
    expect(pattern).to_be_focused()
    expect(position).to_have_accessible_description("Input should be less than or equal to 100 (m)")
    access.look(page, "fixture refused")
    page.screenshot(path=shots / "fixture-refused.png", full_page=True)
    assert stations.fixture("fixed") == FIXTURE
    pattern.fill(FIXTURE["target"])
    position.fill("250")
    card.get_by_role("button", name="Save").click()

    expect(card).to_contain_text("at (1500 / 250 / 1000) mm")
    assert not access.found, "\n".join(access.found)
    assert [line[:3] for line in watch.refused] == ["422"]


def test_a_fixture_is_removed_after_a_question(page: Page, stations: Stations) -> None:
    card = card_of(page, stations, "fixed")
    remove = card.get_by_role("button", name="Remove: Fixture of fixed")
    remove.click()
    question = page.get_by_role("dialog", name="Remove the fixture?")
    question.get_by_role("button", name="Leave it as it is").click()
    assert stations.fixture("fixed") == FIXTURE
    remove.click()
    question.get_by_role("button", name="Remove", exact=True).click()

    expect(card.get_by_role("button", name="Set: Fixture of fixed")).to_be_visible()
    assert stations.fixture("fixed") is None


def test_only_engineers_are_offered_to_change_a_fixture(page: Page, stations: Stations) -> None:
    card = card_of(page, stations, "fixed", stations.key_of("operator"))

    expect(card).to_contain_text("at (1500 / 200 / 1000) mm")
    expect(card.get_by_role("button", name="Fixture of fixed")).to_have_count(0)


@pytest.mark.parametrize(("language", "theme"), [("de", "Dunkel"), ("zh", "深色")])
def test_the_form_holds_in_other_languages_in_the_dark_and_on_a_narrow_screen(
    page: Page, stations: Stations, shots: Path, language: str, theme: str
) -> None:
    card = card_of(page, stations, "fixed")
    card.get_by_role("button", name="Change: Fixture of fixed").click()
    page.get_by_label("Language").select_option(language)
    page.get_by_role("button", name=theme).click()
    page.screenshot(path=shots / f"fixture-{language}-dark.png", full_page=True)
    page.set_viewport_size({"width": 420, "height": 900})
    page.wait_for_timeout(300)
    page.screenshot(path=shots / f"fixture-{language}-narrow.png", full_page=True)

    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
