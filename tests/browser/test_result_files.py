"""The files of a run on its page: its certificate, its exports, and a FAIL only after it is asked for."""

import re
from pathlib import Path

import httpx
from playwright.sync_api import Locator, Page, expect

from service.usecases.certificate import check_certificate
from service.usecases.signing import read_key_set
from tests.browser.calibrated import Runs
from tests.browser.chromium import Watch
from tests.browser.serving import Serving

NAMES = [
    "OpenCV",
    "ROS camera_info",
    "Kalibr camchain",
    "Binary block",
    "CSV",
    "Parquet",
    "PDF report",
    "JSON",
]


def open_run(page: Page, serving: Serving, run_id: str) -> Locator:
    page.goto(f"{serving.url}/#key={serving.key}&/runs/{run_id}")
    panel = page.locator(".files-panel")
    expect(panel.get_by_role("listitem")).to_have_count(len(NAMES), timeout=20_000)
    return panel


def downloaded(page: Page, panel: Locator, button: str) -> tuple[str, bytes]:
    with page.expect_download() as waiting:
        panel.get_by_role("button", name=button).click()
    file = waiting.value
    return file.suggested_filename, Path(file.path()).read_bytes()


def test_a_certificate_and_exports_are_downloaded(
    page: Page, serving: Serving, runs: Runs, shots: Path, watch: Watch
) -> None:
    panel = open_run(page, serving, runs.passing["run_id"])
    assert panel.get_by_role("listitem").all_inner_texts() == NAMES

    name, token = downloaded(page, panel, "Certificate (.jws)")
    report, content = downloaded(page, panel, "PDF report")

    keys = read_key_set(httpx.get(f"{serving.url}/.well-known/jwks.json").content)
    assert check_certificate(token, keys).content["run"]["serial"] == "VIN-PASS-0001"
    assert re.fullmatch(r"VIN-PASS-0001-\d{8}T\d{6}Z-certificate\.jws", name)
    assert re.fullmatch(r"VIN-PASS-0001-\d{8}T\d{6}Z-pdf\.pdf", report)
    assert content.startswith(b"%PDF")
    (shots / "report.pdf").write_bytes(content)
    panel.screenshot(path=shots / "files-pass.png")
    page.screenshot(path=shots / "run-with-files.png", full_page=True)
    assert watch.errors == []


def test_what_a_format_cannot_say_is_told_on_the_page(page: Page, serving: Serving, runs: Runs) -> None:
    panel = open_run(page, serving, runs.passing["run_id"])

    panel.get_by_role("button", name="Kalibr camchain").click()

    expect(panel.get_by_text("Kalibr has no words for")).to_be_visible()


def test_a_failed_camera_is_exported_only_after_it_is_asked_for(
    page: Page, serving: Serving, runs: Runs, shots: Path
) -> None:
    panel = open_run(page, serving, runs.failing["run_id"])
    report = panel.get_by_role("button", name="PDF report")
    expect(report).to_be_disabled()
    expect(panel.get_by_text("It says FAIL")).to_be_visible()
    panel.screenshot(path=shots / "files-fail.png")

    panel.get_by_label("This camera failed").check()
    expect(report).to_be_enabled()
    name, content = downloaded(page, panel, "PDF report")

    assert name.endswith("-pdf-FAIL.pdf")
    (shots / "report-fail.pdf").write_bytes(content)


def test_an_open_run_has_no_files(page: Page, serving: Serving, runs: Runs) -> None:
    page.goto(f"{serving.url}/#key={serving.key}&/runs/{runs.open_id}")

    expect(page.get_by_role("heading", name="VIN-OPEN-0003")).to_be_visible(timeout=20_000)
    expect(page.locator(".files-panel")).to_have_count(0)
