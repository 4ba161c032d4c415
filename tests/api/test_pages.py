"""The pages of the service: documentation, the built web interface, and the headers that guard them."""

import re
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from service.api.application import create_api
from service.api.static import web_directory
from tests.plant import problem


@pytest.fixture
def web(tmp_path: Path) -> Path:
    built = tmp_path / "dist"
    (built / "assets").mkdir(parents=True)
    (built / "dashboard.html").write_text("<title>dmscal</title>")
    (built / "kiosk.html").write_text("<title>kiosk</title>")
    (built / "assets" / "dashboard-1a2b.js").write_text("export {}")
    (tmp_path / "secret.txt").write_text("secret")
    return built


@pytest.fixture
def client(web: Path) -> TestClient:
    app = create_api()
    app.dependency_overrides[web_directory] = lambda: web
    return TestClient(app)


def test_the_documentation_needs_nothing_from_elsewhere(client: TestClient) -> None:
    page = client.get("/api/docs").text

    assert not re.search(r"<script|<link|src=|https?://", page)
    for path in ("/api/v1/runs", "/api/v1/runs/{run_id}/finish", "/api/v1/vehicles/{serial}"):
        assert path in page
    for anchor in set(re.findall(r"href='#([^']+)'", page)):
        assert f"id='{anchor}'" in page


def test_the_openapi_document_is_served(client: TestClient) -> None:
    assert client.get("/openapi.json").json()["info"]["title"] == "dmscal"


def test_the_first_page_is_always_asked_for_again_and_assets_never(client: TestClient) -> None:
    first, asset = client.get("/"), client.get("/assets/dashboard-1a2b.js")

    assert (first.text, first.headers["cache-control"]) == ("<title>dmscal</title>", "no-cache")
    assert asset.headers["cache-control"] == "public, max-age=31536000, immutable"
    assert asset.headers["content-type"].startswith("text/javascript")


def test_the_kiosk_has_an_address_of_its_own_and_is_always_asked_for_again(client: TestClient) -> None:
    kiosk = client.get("/kiosk?station=line1")

    assert (kiosk.text, kiosk.headers["cache-control"]) == ("<title>kiosk</title>", "no-cache")


@pytest.mark.parametrize("address", ["/", "/kiosk"])
def test_a_page_that_was_not_built_says_how_to_build_it(tmp_path: Path, address: str) -> None:
    app = create_api()
    app.dependency_overrides[web_directory] = lambda: tmp_path / "nowhere"

    page = TestClient(app).get(address)

    assert page.status_code == 200
    assert "make setup" in page.text


@pytest.mark.parametrize(
    "path",
    ["/../secret.txt", "/..%2fsecret.txt", "/assets/..%2f..%2fsecret.txt", "/assets", "/%2e%2e/secret.txt"],
)
def test_nothing_outside_the_web_interface_is_served(client: TestClient, path: str) -> None:
    answer = client.get(path)

    assert "secret" not in answer.text.replace("secret.txt", "")
    problem(answer, 404, "not-found")


@pytest.mark.parametrize("path", ["/", "/api/docs", "/nothing", "/problems", "/livez", "/api/v1/runs"])
def test_every_answer_carries_the_headers_that_guard_browsers(client: TestClient, path: str) -> None:
    client.app.state.services = None  # type: ignore[attr-defined]
    headers = TestClient(client.app, raise_server_exceptions=False).get(path).headers

    assert "default-src 'self'" in headers["content-security-policy"]
    assert "script-src" not in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["x-frame-options"] == "DENY"
    assert len(headers["x-trace-id"]) == 32
