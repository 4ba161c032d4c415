"""The built web interface: pages and hashed assets, from the wheel or from a checkout's `web/dist`."""

from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Depends
from fastapi.responses import FileResponse, Response

from service.api.auth import PUBLIC
from service.api.page import page
from service.core.errors import NotFound

router = APIRouter(dependencies=[PUBLIC], include_in_schema=False)

PACKAGE = Path(__file__).resolve().parent.parent
FIRST_PAGE = "dashboard.html"
KIOSK_PAGE = "kiosk.html"
# Vite names assets by their content, so that a changed file has another address.
HASHED = "public, max-age=31536000, immutable"
FRESH = "no-cache"
NOT_BUILT = (
    "<p>The service runs; its web interface was not built. In a checkout, run <code>make setup</code>, "
    "then restart.</p>"
    "<p>Meanwhile: <a href='/api/docs'>the API's documentation</a>, <a href='/readyz'>readiness</a>.</p>"
)


def web_directory() -> Path:
    """Return where the built web interface is, or would be."""
    installed = PACKAGE / "web"
    return installed if installed.is_dir() else PACKAGE.parent / "web" / "dist"


WebDirectory = Annotated[Path, Depends(web_directory)]


@router.get("/")
def read_first_page(web: WebDirectory) -> Response:
    """Answer the first page, or a page that says how to build it."""
    return _page_of(web / FIRST_PAGE)


@router.get("/kiosk")
def read_kiosk(web: WebDirectory) -> Response:
    """Answer the page of a station; `?station=CODE` says which one."""
    return _page_of(web / KIOSK_PAGE)


@router.get("/{path:path}")
def read_file(path: str, web: WebDirectory) -> Response:
    """Answer a file of the web interface."""
    root = web.resolve()
    file = (root / path).resolve()
    # An address must not lead out of the directory, whatever dots and links it holds.
    if path.startswith("api/") or not file.is_relative_to(root) or not file.is_file():
        raise NotFound(
            "There is nothing at this address. The documentation at /api/docs lists the addresses."
        )
    cached = HASHED if path.startswith("assets/") else FRESH
    return FileResponse(file, headers={"Cache-Control": cached})


def _page_of(file: Path) -> Response:
    if not file.is_file():
        return page("dmscal", NOT_BUILT)
    return FileResponse(file, headers={"Cache-Control": FRESH})
