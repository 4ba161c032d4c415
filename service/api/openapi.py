"""The OpenAPI document: what FastAPI finds in the routes, with problems described as they are sent."""

from typing import Any

from fastapi import FastAPI

from service.api.problems import MEDIA_TYPE, Problem

DESCRIPTION = """\
Calibration of driver-monitoring cameras on a production line.

**From a MES, a run is four steps.** Open a run with the vehicle's serial and an `Idempotency-Key`; have its
images uploaded (a kiosk does this); finish it; read the verdict. A result is stored before it is answered.
Any request may be repeated when its answer was lost: opening a run by its `Idempotency-Key`, an upload by
its content, a finish by reading the result that the problem `run-already-finished` names.

**A camera that fails is a result**, with the verdict FAIL and a sentence per gate that says what to do.
Whatever else goes wrong is a problem document (RFC 9457) with a stable `code`, a `detail` that says what to
do and `facts` for programs; each code has a page under `/problems/`.

**Keys.** Send `Authorization: Bearer dmscal_…`. Roles rise viewer < operator < engineer < admin; `mes`
reads and opens runs. Lists come in parts, newest first: give `next_cursor` back as `cursor`. Times are UTC,
lengths m, pixels px.
"""
TAGS = [
    {
        "name": "Runs",
        "description": "Calibrate one camera of one vehicle: open, upload, finish, read the verdict.",
    },
    {"name": "Captures", "description": "The images of a run and the corners found in them."},
    {"name": "Results", "description": "Verdict, intrinsics with their uncertainty, and every gate."},
    {"name": "Exports", "description": "Results as files, and the block of a camera's memory."},
    {"name": "Vehicles", "description": "All that is known under one serial."},
    {"name": "SKUs", "description": "Camera variants and their revisions."},
    {
        "name": "Pose sets",
        "description": "The poses an operator is asked for, planned before anybody lifts a board.",
    },
    {"name": "Jobs", "description": "Work in the background."},
    {"name": "Targets", "description": "The physical boards."},
    {"name": "Stations", "description": "The calibration places of the line."},
    {"name": "Statistics", "description": "Yield of the last days, and what the stations do now."},
    {"name": "API keys", "description": "Who may ask for what."},
    {"name": "Health", "description": "For the plant's monitoring; no key needed."},
]
PROBLEM_ANSWERS: dict[int | str, dict[str, Any]] = {
    "default": {"description": "A problem document that says what is wrong and what to do.", "model": Problem}
}


def openapi_document(app: FastAPI) -> dict[str, Any]:
    """Return the document; problems get their own media type, which FastAPI cannot say with a model."""
    document: dict[str, Any] = app.openapi()
    for operations in document["paths"].values():
        for operation in operations.values():
            problem = operation["responses"].get("default")
            if problem is not None and "application/json" in problem["content"]:
                problem["content"] = {MEDIA_TYPE: problem["content"]["application/json"]}
    return document
