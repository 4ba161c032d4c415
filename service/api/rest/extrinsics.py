"""Extrinsics after the run: where a camera that was calibrated before is in its vehicle."""

from datetime import datetime
from typing import Annotated, Any
from uuid import UUID

from fastapi import APIRouter, Path, Query, Response
from pydantic import Field

from service.api.auth import Operator, Viewer
from service.api.dependencies import Now, Of, PageOf, ReadDb
from service.api.files import attachment
from service.api.rest.results import Extrinsics, Measurement
from service.api.shapes import Answer, Id, Page
from service.api.uploads import UPLOADS_BODY, Uploads
from service.core.quality.gates import Verdict
from service.usecases import later_certificate, later_extrinsics, later_extrinsics_views
from service.usecases.certificate import MEDIA_TYPE
from service.usecases.observation import Picture
from service.usecases.text import Code

router = APIRouter(tags=["Results"])


class LaterPicture(Answer):
    """A picture of the fixed target."""

    id: UUID
    number: int = Field(description="From 1, in the order in which they were sent.")
    file_name: str
    sha256: str
    image_url: str


class LaterExtrinsics(Answer):
    """Where the camera of a finished run is in the vehicle, measured after the run."""

    id: UUID
    run_id: UUID = Field(description="Whose intrinsics were used.")
    serial: str
    station: str = Field(description="Code of the station whose fixed target the pictures show.")
    verdict: Verdict = Field(description="Of the gate `extrinsics` alone; the run keeps its own verdict.")
    extrinsics: Extrinsics
    gates: list[Measurement]
    pictures: list[LaterPicture]
    versions: dict[str, str]
    created_at: datetime
    created_by: str


ANSWERS: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The very same pictures were sent before; this is what they gave.",
        "model": LaterExtrinsics,
    }
}


@router.post(
    "/runs/{run_id}/extrinsics",
    status_code=201,
    summary="Measure extrinsics with stored intrinsics",
    openapi_extra=UPLOADS_BODY,
    responses=ANSWERS,
)
def measure_extrinsics(
    run_id: Id,
    *,
    caller: Operator,
    uploads: Uploads,
    of: Of,
    now: Now,
    response: Response,
    station: Annotated[Code, Query(description="Where the pictures were taken; it needs a fixture.")],
) -> LaterExtrinsics:
    """Find where a camera that was calibrated before is in its vehicle, from pictures of a fixed target.

    The run must be the newest finished one of its serial and SKU, with the verdict PASS or MARGINAL; its
    intrinsics are taken with their covariance. The camera and the vehicle stand still over all pictures.
    Repeating the request is safe: the same pictures at the same station give the same answer, with 200.
    """
    pictures = tuple(Picture(one.content, one.file_name, of.max_image_pixels) for one in uploads)
    wanted = later_extrinsics.Wanted(run_id, station, pictures)
    placed = later_extrinsics.measure_later(
        of.database, of.blobs, of.signing_keys, wanted, who=caller.name, now=now
    )
    response.status_code = 201 if placed.is_new else 200
    return LaterExtrinsics.model_validate(placed.view)


@router.get("/runs/{run_id}/extrinsics", summary="List the extrinsics measured after a run")
def list_extrinsics(run_id: Id, caller: Viewer, db: ReadDb, page: PageOf) -> Page[LaterExtrinsics]:
    """List what was measured with a run's intrinsics after it was finished, newest first."""
    return Page[LaterExtrinsics].model_validate(later_extrinsics_views.list_later(db, run_id, page))


@router.get("/extrinsics/{extrinsics_id}", summary="Read extrinsics measured after a run")
def read_extrinsics(extrinsics_id: Id, caller: Viewer, db: ReadDb) -> LaterExtrinsics:
    """Read where the camera is, with its covariance, its gates and the pictures behind it."""
    return LaterExtrinsics.model_validate(later_extrinsics_views.read_later(db, extrinsics_id))


@router.get(
    "/extrinsics/{extrinsics_id}/certificate",
    summary="Read the certificate of extrinsics measured after a run",
    response_class=Response,
    responses={200: {"content": {MEDIA_TYPE: {}}, "description": "A compact JWS."}},
)
def read_certificate(extrinsics_id: Id, caller: Viewer, of: Of, now: Now) -> Response:
    """Give what was measured as a signed document: a compact JWS (EdDSA), always the same bytes.

    `dmscal verify` checks it like the certificate of a run, which keeps saying what the run found.
    """
    found = later_certificate.read_later_certificate(
        of.database, of.signing_keys, extrinsics_id, caller.name, now
    )
    return attachment(found.token.encode("ascii"), MEDIA_TYPE, found.file_name)


@router.get(
    "/extrinsics/{extrinsics_id}/pictures/{number}",
    summary="Read a picture behind extrinsics",
    response_class=Response,
    responses={200: {"content": {"image/png": {}, "image/jpeg": {}}, "description": "The image."}},
)
def read_picture(
    extrinsics_id: Id,
    number: Annotated[int, Path(ge=1, le=later_extrinsics.MOST_PICTURES, description="From 1.")],
    caller: Viewer,
    db: ReadDb,
    of: Of,
) -> Response:
    """Read a picture as it was sent; formats that browsers cannot show are converted to PNG."""
    image = later_extrinsics_views.read_later_image(db, of.blobs, extrinsics_id, number)
    headers = {"Cache-Control": "private, max-age=31536000, immutable"}
    return Response(image.content, media_type=image.media_type, headers=headers)
