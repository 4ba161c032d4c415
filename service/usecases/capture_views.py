"""Captures as they are shown, and the image itself. Not here: how they are accepted (`captures`)."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

import cv2
import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.ports import BlobStore
from service.storage.models import CalibrationRow, CaptureRow
from service.storage.words import CaptureRole
from service.usecases.images import decode_image

Point = tuple[float, float]
SHOWN_BY_BROWSERS = {"image/png", "image/jpeg"}


@dataclass(frozen=True, kw_only=True)
class CaptureView:
    """A capture in a list."""

    id: UUID
    run_id: UUID
    number: int
    role: CaptureRole
    pose_index: int | None
    file_name: str
    sha256: str
    media_type: str
    bytes: int
    image_size: tuple[int, int]
    match_error_px: float | None
    edge_width_px: float | None
    created_at: datetime
    image_url: str


@dataclass(frozen=True, kw_only=True)
class CaptureDetailView(CaptureView):
    """A capture with its corners and, where a calibration used it, their reprojections."""

    corners: list[Point]
    reprojected: list[Point] | None
    rms_px: float | None
    sharpness: dict[str, Any]
    parity_separation: float
    contrast: float
    saturated_share: float | None


@dataclass(frozen=True)
class ShownImage:
    """An image that a browser can show."""

    content: bytes
    media_type: str


def view_captures(rows: Iterable[CaptureRow]) -> list[CaptureView]:
    """Return captures as they are listed."""
    return [CaptureView(**_common(row)) for row in rows]


def view_capture_detail(session: Session, row: CaptureRow) -> CaptureDetailView:
    """Return a capture with its corners and reprojections."""
    view = _view_in_calibration(session, row)
    reprojected = None
    if view is not None:
        # Residuals are detected minus projected.
        reprojected = (np.array(row.corners) - np.array(view["residuals"])).tolist()
    return CaptureDetailView(
        **_common(row),
        corners=row.corners,
        reprojected=reprojected,
        rms_px=None if view is None else view["rms_px"],
        sharpness=row.sharpness,
        parity_separation=row.parity_separation,
        contrast=row.contrast,
        saturated_share=row.saturated_share,
    )


def read_image(session: Session, blobs: BlobStore, capture_id: UUID) -> ShownImage:
    """Return the image as it was sent, or in grey as PNG where browsers do not show its format.

    Raises NotFound.
    """
    row = session.get(CaptureRow, capture_id)
    if row is None:
        raise NotFound("There is no capture of this id.", capture_id=str(capture_id))
    return show_image(blobs, row.sha256, row.media_type)


def show_image(blobs: BlobStore, sha256: str, media_type: str) -> ShownImage:
    """Return a stored image so that a browser can show it."""
    content = blobs.get(sha256)
    if media_type in SHOWN_BY_BROWSERS:
        return ShownImage(content, media_type)
    return ShownImage(_to_png(content), "image/png")


def _to_png(content: bytes) -> bytes:
    encoded: bytes = cv2.imencode(".png", decode_image(content, "The image"))[1].tobytes()
    return encoded


def _common(row: CaptureRow) -> dict[str, Any]:
    return {
        "id": row.id,
        "run_id": row.run_id,
        "number": row.number,
        "role": row.role,
        "pose_index": row.pose_index,
        "file_name": row.file_name,
        "sha256": row.sha256,
        "media_type": row.media_type,
        "bytes": row.bytes,
        "image_size": tuple(row.image_size),
        "match_error_px": row.match_error_px,
        "edge_width_px": row.sharpness["edge_width_px"],
        "created_at": row.created_at,
        "image_url": f"/api/v1/captures/{row.id}/image",
    }


def _view_in_calibration(session: Session, row: CaptureRow) -> dict[str, Any] | None:
    document = session.scalar(select(CalibrationRow.document).where(CalibrationRow.run_id == row.run_id))
    views = [] if document is None else list(document["views"])
    if document is not None and document.get("extrinsics") is not None:
        views += document["extrinsics"]["views"]
    return next((view for view in views if view["capture_id"] == str(row.id)), None)
