"""Whatever goes wrong at a kiosk is said there in each language; what cannot be told there is listed here."""

from pathlib import Path

import pytest

from service.api.problem_pages import error_classes

WORDS = Path(__file__).resolve().parents[2] / "web" / "src" / "words"
# How the socket ends: the page has a screen of its own for these.
ENDS = {"not-authenticated", "role-missing", "station-held"}
# To monitors, which no page is yet.
MONITORS = {"kiosk-left"}
# Of other interfaces: files, uploads, plans, keys and the service's start.
ELSEWHERE = {
    "already-exists",
    "block-layout-unusable",
    "certificate-refused",
    "conflict",
    "cursor-invalid",
    "database-outdated",
    "fixture-changed",
    "fixture-file-unreadable",
    "fixture-missing",
    "folder-unusable",
    "format-cannot-say",
    "idempotency-key-reused",
    "image-format-unsupported",
    "image-too-large",
    "image-unreadable",
    "intrinsics-invalid",
    "job-already-ended",
    "key-set-unreadable",
    "limits-invalid",
    "media-type-unsupported",
    "method-not-allowed",
    "paper-unusable",
    "picture-of-another",
    "pose-index-unknown",
    "pose-set-infeasible",
    "pose-set-invalid",
    "pose-set-mismatch",
    "pose-space-empty",
    "pose-undetermined",
    "result-failed",
    "result-not-usable",
    "scene-invalid",
    "sku-file-unreadable",
    "source-refused",
    "target-spec-invalid",
    "unprocessable",
}
# Its words name the SKU, so that they are no plain text.
WITH_FACTS = {"other-sku-open"}
CODES = {kind.code for kind in error_classes()}


@pytest.mark.parametrize("code", sorted(CODES - ENDS - MONITORS - ELSEWHERE - WITH_FACTS))
@pytest.mark.parametrize("language", ["en", "de", "zh"])
def test_a_problem_at_a_kiosk_is_said_with_what_to_do(code: str, language: str) -> None:
    words = (WORDS / f"{language}_kiosk.ts").read_text()
    key = f"told_{code.replace('-', '_')}"

    assert f"  {key}:" in words
    assert f"  {key}_do:" in words


def test_what_cannot_be_told_there_is_a_problem_that_exists() -> None:
    assert CODES >= ENDS | MONITORS | ELSEWHERE | WITH_FACTS
