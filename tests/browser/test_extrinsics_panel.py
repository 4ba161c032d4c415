"""The camera's place in the vehicle on a run's page, measured within the run and after it."""

from pathlib import Path

from playwright.sync_api import Page, expect

from service.demo.customer import Customer
from service.usecases.certificate import check_certificate
from service.usecases.signing import read_key_set
from tests.api.rest.test_extrinsics import FIXTURE, PICTURE, T_VEHICLE_CAM, pose_json
from tests.browser.access import Access
from tests.browser.chromium import Watch
from tests.browser.serving import Serving
from tests.plant import SKU, JsonObject, picture, pose_set, poses_json

Sent = tuple[str, bytes]


def calibrated(customer: Customer, code: str, fixture: JsonObject, *more: Sent, **order: str) -> str:
    """The id of a finished run of a SKU of its own, with a station of the same name that has a fixture.

    more: queries and pictures that are sent beside those of the poses.
    """
    customer.describe_sku({**SKU, "code": code, "mounting": pose_json(T_VEHICLE_CAM)})
    made = customer.ask("POST", f"/skus/{code}/revisions/1/pose-sets", json={"poses": poses_json()})
    customer.ask("POST", f"/pose-sets/{made['pose_set']['id']}/publish")
    customer.ask("POST", "/stations", json={"code": code, "name": code.title(), "fixture": fixture})
    run_id = str(customer.ask("POST", "/runs", json={"sku": code, **order})["id"])
    images = [(f"?pose_index={i}", picture(i)) for i in range(len(pose_set().poses))]
    for query, content in [*images, *more]:
        files = {"image": ("image.png", content, "image/png")}
        customer.ask("POST", f"/runs/{run_id}/captures{query}", files=files)
    customer.ask("POST", f"/runs/{run_id}/finish")
    return run_id


def placed_within(serving: Serving) -> str:
    """The id of a run with a picture of the fixed target."""
    customer = Customer.of(serving.url, serving.key)
    with customer.http:
        of_target = ("?role=extrinsics", PICTURE)
        return calibrated(customer, "fixed1", FIXTURE, of_target, serial="VIN-PLACE", station="fixed1")


def placed_later(serving: Serving) -> str:
    """The id of a run whose camera was found far from where it belongs, after the run."""
    customer = Customer.of(serving.url, serving.key)
    moved = {**FIXTURE, "pose": {**FIXTURE["pose"], "tvec": [1.52, 0.2, 1.0]}}
    with customer.http:
        run_id = calibrated(customer, "later1", moved, serial="VIN-LATER", purpose="simulated")
        files = {"image": ("image.png", PICTURE, "image/png")}
        customer.ask("POST", f"/runs/{run_id}/extrinsics?station=later1", files=files)
    return run_id


def test_the_place_in_the_vehicle_is_shown_with_its_uncertainty(
    page: Page, serving: Serving, watch: Watch, shots: Path
) -> None:
    run_id = placed_within(serving)
    page.set_viewport_size({"width": 1600, "height": 1400})
    page.goto(f"{serving.url}/#key={serving.key}&/runs/{run_id}")

    panel = page.get_by_role("region", name="Place in the vehicle")

    expect(panel.locator("tbody tr")).to_have_count(6)
    expect(panel).to_contain_text(FIXTURE["target"])
    expect(page.get_by_text("Position from nominal")).to_be_visible()
    page.screenshot(path=shots / "run-extrinsics.png", full_page=True)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])


def test_what_was_measured_after_the_run_is_shown_with_its_own_verdict(
    page: Page, serving: Serving, watch: Watch, shots: Path, access: Access
) -> None:
    run_id = placed_later(serving)
    page.set_viewport_size({"width": 1600, "height": 1400})
    page.goto(f"{serving.url}/#key={serving.key}&/runs/{run_id}")

    panel = page.get_by_role("region", name="Place in the vehicle, after the run")

    expect(panel.locator("tbody tr")).to_have_count(6)
    expect(panel).to_contain_text("at later1")
    expect(panel.locator(".tag")).to_have_text("FAIL")
    expect(panel).to_contain_text("The camera is not where it belongs.")
    expect(page.locator(".banner")).to_contain_text("PASS")
    with page.expect_download() as download:
        panel.get_by_role("button", name="Certificate (.jws)").click()
    keys = read_key_set(page.request.get(f"{serving.url}/.well-known/jwks.json").body())
    genuine = check_certificate(Path(download.value.path()).read_bytes(), keys)
    assert "FAIL" in download.value.suggested_filename
    assert (genuine.content["verdict"], genuine.content["run"]["serial"]) == ("FAIL", "VIN-LATER")
    access.look(page, "extrinsics after the run")
    page.screenshot(path=shots / "run-later-extrinsics.png", full_page=True)
    assert not access.found, "\n".join(access.found)
    assert (watch.errors, watch.outside, watch.refused) == ([], [], [])
