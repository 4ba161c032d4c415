"""Captures: the images of a run, with the corners that were found in them."""

from datetime import datetime
from typing import Annotated, Any
from uuid import UUID

from fastapi import APIRouter, Query, Response
from pydantic import Field

from service.api.auth import Operator, Viewer
from service.api.dependencies import Db, Now, Of, ReadDb
from service.api.shapes import Answer, Id
from service.api.uploads import UPLOAD_BODY, Upload
from service.storage.words import CaptureRole
from service.usecases import capture_views, captures
from service.usecases.observation import Picture

router = APIRouter(tags=["Captures"])

Point = tuple[float, float]
PoseIndex = Annotated[
    int | None, Query(ge=0, le=999, description="Which pose of the run's pose set this image shows, from 0.")
]


class Capture(Answer):
    """One accepted image of a run."""

    id: UUID
    run_id: UUID
    number: int = Field(description="Order within the run, from 1.")
    role: CaptureRole = Field(description="`extrinsics`: a picture of the station's fixed target.")
    pose_index: int | None
    file_name: str
    sha256: str
    media_type: str
    bytes: int
    image_size: tuple[int, int]
    match_error_px: float | None = Field(
        description="Mean distance of the four outer corners from the prescribed pose; judged at finish."
    )
    edge_width_px: float | None = Field(description="Median 10-90 % width of the board's edges.")
    created_at: datetime
    image_url: str


class Sharpness(Answer):
    """Widths of the board's edges, px; by image quadrant tl, tr, br, bl (null: too few edges)."""

    edge_width_px: float | None
    quadrants_px: tuple[float | None, float | None, float | None, float | None]
    centre_px: float | None


class CaptureDetail(Capture):
    """An image with its corners and, once the run is finished, where the calibrated camera puts them."""

    corners: list[Point]
    reprojected: list[Point] | None
    rms_px: float | None
    sharpness: Sharpness
    parity_separation: float
    contrast: float
    saturated_share: float | None = Field(
        description="Share of the bright squares that is saturated; null in captures of before."
    )


UPLOAD_ANSWERS: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The very same upload was accepted before; this is its capture.",
        "model": CaptureDetail,
    }
}


@router.post(
    "/runs/{run_id}/captures",
    status_code=201,
    summary="Upload an image",
    openapi_extra=UPLOAD_BODY,
    responses=UPLOAD_ANSWERS,
)
def create_capture(
    run_id: Id,
    *,
    caller: Operator,
    upload: Upload,
    of: Of,
    now: Now,
    response: Response,
    pose_index: PoseIndex = None,
    role: Annotated[
        CaptureRole,
        Query(description="`extrinsics`: the image shows the fixed target of the run's station."),
    ] = CaptureRole.INTRINSICS,
) -> CaptureDetail:
    """Accept an image: it must show the SKU's whole target at the SKU's image size.

    Send it as it comes from the camera, lossless (PNG, PGM, BMP, TIFF) where possible. A refused image
    changes nothing. Repeating an upload is safe: the same image for the same pose gives the same capture
    with 200.
    """
    picture = Picture(upload.content, upload.file_name, of.max_image_pixels)
    accepted = captures.add_capture(
        of.database, of.blobs, run_id, picture, pose_index=pose_index, role=role, who=caller.name, now=now
    )
    response.status_code = 201 if accepted.is_new else 200
    return CaptureDetail.model_validate(accepted.view)


@router.get("/captures/{capture_id}", summary="Read a capture")
def read_capture(capture_id: Id, caller: Viewer, db: ReadDb) -> CaptureDetail:
    """Read a capture with its corners."""
    return CaptureDetail.model_validate(captures.read_capture(db, capture_id))


@router.get(
    "/captures/{capture_id}/image",
    summary="Read the image of a capture",
    response_class=Response,
    responses={200: {"content": {"image/png": {}, "image/jpeg": {}}, "description": "The image."}},
)
def read_image(capture_id: Id, caller: Viewer, db: ReadDb, of: Of) -> Response:
    """Read the image as it was uploaded; formats that browsers cannot show are converted to PNG."""
    image = capture_views.read_image(db, of.blobs, capture_id)
    headers = {"Cache-Control": "private, max-age=31536000, immutable"}
    return Response(image.content, media_type=image.media_type, headers=headers)


@router.delete("/runs/{run_id}/captures/{capture_id}", status_code=204, summary="Withdraw a capture")
def delete_capture(run_id: Id, capture_id: Id, caller: Operator, db: Db, now: Now) -> None:
    """Withdraw an image from an open run, to take it again. A finished run keeps its images."""
    captures.withdraw_capture(db, run_id, capture_id, caller.name, now)
