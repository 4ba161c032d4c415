"""The tables of extrinsics that were measured after their run, with the run's stored intrinsics.

Not here: extrinsics that a run measures itself; they stand in its calibration (`models`).
"""

from datetime import datetime
from uuid import UUID

from sqlalchemy import CheckConstraint, Index, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from service.core.quality.gates import Verdict
from service.storage.columns import new_id, word
from service.storage.models import JsonObject, Row, SeenPicture, SignedDocument, refers_to


class LaterExtrinsicsRow(Row):
    """Where the camera of a finished run is in its vehicle; never changed, a new measurement is a new row.

    fixture: where the target stood. request_sha256: of pictures, station and fixture, so that a request that
    comes twice is known. document: the extrinsics and their gates as they were reported.
    """

    __tablename__ = "later_extrinsics"
    __table_args__ = (
        UniqueConstraint("run_id", "request_sha256"),
        Index(None, "run_id", "created_at", "id"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    run_id: Mapped[UUID] = mapped_column(refers_to("run.id"))
    station_id: Mapped[UUID] = mapped_column(refers_to("station.id"))
    request_sha256: Mapped[str]
    fixture: Mapped[JsonObject]
    verdict: Mapped[Verdict] = mapped_column(word(Verdict, "verdict"))
    document: Mapped[JsonObject]
    versions: Mapped[JsonObject]
    created_at: Mapped[datetime]
    created_by: Mapped[str]


class LaterPictureRow(SeenPicture, Row):
    """A picture of the fixed target, and what was seen in it; the image is in the blob store by `sha256`."""

    __tablename__ = "later_picture"
    __table_args__ = (
        UniqueConstraint("later_extrinsics_id", "number"),
        CheckConstraint("number >= 1", name="number_from_1"),
        CheckConstraint("length(sha256) = 64", name="sha256_is_hex"),
        Index(None, "sha256"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    later_extrinsics_id: Mapped[UUID] = mapped_column(refers_to("later_extrinsics.id"))


class LaterCertificateRow(SignedDocument, Row):
    """The signed certificate of extrinsics that were measured after their run."""

    __tablename__ = "later_certificate"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    later_extrinsics_id: Mapped[UUID] = mapped_column(refers_to("later_extrinsics.id"), unique=True)
