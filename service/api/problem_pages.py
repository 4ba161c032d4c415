"""The pages under /problems that explain each code: what it means and what to do."""

import html
from collections.abc import Mapping

from fastapi import APIRouter
from fastapi.responses import HTMLResponse

from service.api.auth import PUBLIC
from service.api.page import page
from service.api.problems import status_of
from service.core.errors import (
    BadRequest,
    Conflict,
    IdempotencyKeyReused,
    InternalError,
    MediaTypeUnsupported,
    MethodNotAllowed,
    NotAllowed,
    NotAuthenticated,
    NotFound,
    RunAlreadyFinished,
    ServiceError,
    TargetNotVisible,
    TooFewViews,
    TooLarge,
    Unavailable,
    Unprocessable,
    WrongTarget,
)

router = APIRouter(prefix="/problems", dependencies=[PUBLIC], include_in_schema=False)

# By kind, for all kinds below it too.
ADVICE: Mapping[type[ServiceError], str] = {
    BadRequest: "Correct the request as the detail says; sending it again unchanged cannot help.",
    NotAuthenticated: "Send a valid API key in the header 'Authorization: Bearer dmscal_...'. "
    "An administrator replaces a lost key by a new one.",
    NotAllowed: "Use a key with the role that the facts name, or ask an administrator for one.",
    NotFound: "Check the address and the id, and list what there is. Ids never change.",
    MethodNotAllowed: "Use one of the methods that the header Allow names.",
    Conflict: "Read the thing that the facts name and decide by its present state. Nothing was changed.",
    RunAlreadyFinished: "Read the result at the address in the facts: if your own finish is answered by "
    "this, it had succeeded and only its answer was lost. For another calibration open a new run.",
    TooLarge: "Send the image as the camera delivers it, uncropped and not enlarged.",
    MediaTypeUnsupported: "Send the image as multipart/form-data in a field named 'image', "
    "or as the body with an image/* type.",
    Unprocessable: "Correct the content as the detail says, then send it again. Nothing was changed.",
    IdempotencyKeyReused: "Take a new key for a new request; repeat a request with exactly the same content.",
    TargetNotVisible: "Hold the whole board into the picture, evenly lit, sharp and without a finger on its "
    "squares; then take the image again.",
    WrongTarget: "Use the board that the SKU names, or correct the SKU's target.",
    TooFewViews: "The run stays open: take more images of the board in clearly different poses, then finish.",
    InternalError: "Try again. If it stays, report the trace id: the service's log has the cause under it.",
    Unavailable: "Nothing was stored. Try again in a moment; if it stays, have the named part checked.",
}


def error_classes(root: type[ServiceError] = ServiceError) -> list[type[ServiceError]]:
    """Return every kind of error that can be answered: all below the root, parents first."""
    found: list[type[ServiceError]] = []
    for kind in root.__subclasses__():
        found += [kind, *error_classes(kind)]
    return found


@router.get("")
def list_problems() -> HTMLResponse:
    """List all codes."""
    rows = "".join(
        f"<tr><td><a href='/problems/{kind.code}'>{kind.code}</a><td>{status_of(kind).value}"
        f"<td>{html.escape(kind.title)}"
        for kind in sorted(error_classes(), key=lambda kind: kind.code)
    )
    return page("Problems", f"<table><tr><th>Code<th>Status<th>Meaning{rows}</table>")


@router.get("/{code}")
def explain_problem(code: str) -> HTMLResponse:
    """Explain one code."""
    kind = next((kind for kind in error_classes() if kind.code == code), None)
    if kind is None:
        raise NotFound("There is no problem of this code. The page /problems lists them all.", code=code[:80])
    meaning = html.escape(" ".join((kind.__doc__ or kind.title).split()))
    body = (
        f"<p>{meaning}</p><p>HTTP status {status_of(kind).value}. Code <code>{kind.code}</code>.</p>"
        f"<h2>What to do</h2><p>{html.escape(_advice(kind))}</p>"
        "<p>The problem document itself says in <code>detail</code> what was wrong in your case, and gives "
        "values in <code>facts</code>. Give its <code>trace_id</code> when you report it.</p>"
        "<p><a href='/problems'>All problems</a></p>"
    )
    return page(kind.title, body)


def _advice(kind: type[ServiceError]) -> str:
    return next(ADVICE[parent] for parent in kind.__mro__ if parent in ADVICE)
