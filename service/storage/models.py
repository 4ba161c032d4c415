"""The tables, as typed rows. Rows are records: what they mean is decided in the core and in the use cases.

Ids are made in Python and foreign keys are checked at commit, so rows may be added in any order. Times come
from the caller's clock. JSON holds no NaN or infinity: what is not known is null. Arrays are lists of floats.
Not here: what is learnt over many runs (`learnt`).
"""

from datetime import datetime
from typing import Any, dataclass_transform
from uuid import UUID

from sqlalchemy import CheckConstraint, Double, ForeignKey, Index, MetaData, String, UniqueConstraint, Uuid
from sqlalchemy.orm import DeclarativeBase, Mapped, MappedAsDataclass, mapped_column

from service.core.guidance.actions import AddedFor
from service.core.quality.gates import Verdict
from service.core.run import Outcome, Purpose, RunState
from service.storage.columns import Json, UtcDateTime, new_id, word
from service.storage.words import CaptureRole, FrameOrigin, JobState, Language, Publication, Role

JsonObject = dict[str, Any]
JsonArray = list[Any]


@dataclass_transform(kw_only_default=True, field_specifiers=(mapped_column,))
class Row(MappedAsDataclass, DeclarativeBase, kw_only=True, eq=False, repr=False):
    """A row of any table: a keyword-only constructor, equality by identity."""

    metadata = MetaData(
        naming_convention={
            "ix": "ix_%(table_name)s_%(column_0_N_name)s",
            "uq": "uq_%(table_name)s_%(column_0_N_name)s",
            "ck": "ck_%(table_name)s_%(constraint_name)s",
            "fk": "fk_%(table_name)s_%(column_0_name)s_%(referred_table_name)s",
            "pk": "pk_%(table_name)s",
        }
    )
    type_annotation_map = {  # noqa: RUF012 - SQLAlchemy reads it as a plain dict
        datetime: UtcDateTime(),
        UUID: Uuid(),
        str: String(),
        float: Double(),
        JsonObject: Json,
        JsonArray: Json,
    }


def refers_to(column: str) -> ForeignKey:
    """Return a foreign key that is checked at commit."""
    return ForeignKey(column, deferrable=True, initially="DEFERRED")


class TargetRow(Row):
    """A physical plate with its pattern; plates are told apart by their serial."""

    __tablename__ = "target"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    serial: Mapped[str | None] = mapped_column(unique=True, default=None)
    spec: Mapped[str]
    # How far a corner may move from the certified shape.
    drift_limit_mm: Mapped[float] = mapped_column(default=0.1, server_default="0.1")
    created_at: Mapped[datetime]


class SkuRow(Row):
    """A camera variant; all that can change is in its revisions."""

    __tablename__ = "sku"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    code: Mapped[str] = mapped_column(unique=True)
    name: Mapped[str]
    created_at: Mapped[datetime]


class SkuRevisionRow(Row):
    """One revision of a SKU's document, never edited once published."""

    __tablename__ = "sku_revision"
    __table_args__ = (
        UniqueConstraint("sku_id", "number"),
        CheckConstraint("number >= 1", name="number_from_1"),
        CheckConstraint("state <> 'published' OR published_at IS NOT NULL", name="published_has_time"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    sku_id: Mapped[UUID] = mapped_column(refers_to("sku.id"))
    number: Mapped[int]
    document: Mapped[JsonObject]
    state: Mapped[Publication] = mapped_column(word(Publication, "state"), default=Publication.DRAFT)
    created_at: Mapped[datetime]
    published_at: Mapped[datetime | None] = mapped_column(default=None)


class JobRow(Row):
    """Work in the background. `claimed_by` and `heartbeat_at` tell a running job from an orphan."""

    __tablename__ = "job"
    __table_args__ = (
        CheckConstraint("progress BETWEEN 0 AND 1", name="progress_is_share"),
        CheckConstraint("state <> 'running' OR claimed_by IS NOT NULL", name="running_is_claimed"),
        Index(None, "state", "created_at"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    kind: Mapped[str]
    state: Mapped[JobState] = mapped_column(word(JobState, "state"), default=JobState.QUEUED)
    progress: Mapped[float] = mapped_column(default=0.0)
    arguments: Mapped[JsonObject]
    result: Mapped[JsonObject | None] = mapped_column(default=None)
    problem: Mapped[JsonObject | None] = mapped_column(default=None)
    attempts: Mapped[int] = mapped_column(default=0)
    claimed_by: Mapped[UUID | None] = mapped_column(default=None)
    created_at: Mapped[datetime]
    started_at: Mapped[datetime | None] = mapped_column(default=None)
    heartbeat_at: Mapped[datetime | None] = mapped_column(default=None)
    finished_at: Mapped[datetime | None] = mapped_column(default=None)


class PoseSetRow(Row):
    """The ordered poses of a SKU revision, what they promise, and how they were found."""

    __tablename__ = "pose_set"
    __table_args__ = (
        CheckConstraint("state <> 'published' OR published_at IS NOT NULL", name="published_has_time"),
        Index(None, "sku_revision_id", "state"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    sku_revision_id: Mapped[UUID] = mapped_column(refers_to("sku_revision.id"))
    state: Mapped[Publication] = mapped_column(word(Publication, "state"), default=Publication.DRAFT)
    poses: Mapped[JsonArray]
    prediction: Mapped[JsonObject]
    provenance: Mapped[JsonObject]
    job_id: Mapped[UUID | None] = mapped_column(refers_to("job.id"), default=None)
    created_at: Mapped[datetime]
    published_at: Mapped[datetime | None] = mapped_column(default=None)
    published_by: Mapped[str | None] = mapped_column(default=None)
    retired_at: Mapped[datetime | None] = mapped_column(default=None)
    retired_by: Mapped[str | None] = mapped_column(default=None)


class StationRow(Row):
    """A calibration place on the line."""

    __tablename__ = "station"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    code: Mapped[str] = mapped_column(unique=True)
    name: Mapped[str]
    target_id: Mapped[UUID | None] = mapped_column(refers_to("target.id"), default=None)
    source: Mapped[str] = mapped_column(
        default=FrameOrigin.BROWSER.value, server_default=FrameOrigin.BROWSER.value
    )
    language: Mapped[Language | None] = mapped_column(word(Language, "language"), default=None)
    fixture: Mapped[JsonObject | None] = mapped_column(default=None)
    created_at: Mapped[datetime]


class RunRow(Row):
    """One calibration of one camera of one vehicle; a retest is a new run."""

    __tablename__ = "run"
    __table_args__ = (
        CheckConstraint("(state = 'open') = (finished_at IS NULL)", name="ended_has_time"),
        CheckConstraint("(state = 'finished') = (verdict IS NOT NULL)", name="finished_has_verdict"),
        Index(None, "serial", "created_at", "id"),
        Index(None, "created_at", "id"),
        Index(None, "station_id", "state", "created_at", "id"),
        Index(None, "target_id", "state", "created_at", "id"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    sku_revision_id: Mapped[UUID] = mapped_column(refers_to("sku_revision.id"))
    pose_set_id: Mapped[UUID | None] = mapped_column(refers_to("pose_set.id"), default=None)
    station_id: Mapped[UUID | None] = mapped_column(refers_to("station.id"), default=None)
    # The board that stood at the station when the run was opened.
    target_id: Mapped[UUID | None] = mapped_column(refers_to("target.id"), default=None)
    serial: Mapped[str]
    purpose: Mapped[Purpose] = mapped_column(word(Purpose, "purpose"), default=Purpose.PRODUCTION)
    state: Mapped[RunState] = mapped_column(word(RunState, "state"), default=RunState.OPEN)
    verdict: Mapped[Verdict | None] = mapped_column(word(Verdict, "verdict"), default=None)
    outcome: Mapped[Outcome | None] = mapped_column(word(Outcome, "outcome"), default=None)
    created_by: Mapped[str]
    created_at: Mapped[datetime]
    finished_at: Mapped[datetime | None] = mapped_column(default=None)


class RunPoseRow(Row):
    """A pose that a run asks for beyond its pose set; its index follows those of the set."""

    __tablename__ = "run_pose"
    __table_args__ = (UniqueConstraint("run_id", "pose_index"),)

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    run_id: Mapped[UUID] = mapped_column(refers_to("run.id"))
    pose_index: Mapped[int]
    pose: Mapped[JsonObject]
    reason: Mapped[AddedFor] = mapped_column(word(AddedFor, "reason"))
    replaces: Mapped[int | None] = mapped_column(default=None)
    created_at: Mapped[datetime]


class SeenPicture(MappedAsDataclass, kw_only=True, eq=False, repr=False):
    """What a row holds of a picture and of what was seen in it; number: within what it belongs to."""

    number: Mapped[int]
    file_name: Mapped[str]
    sha256: Mapped[str]
    media_type: Mapped[str]
    bytes: Mapped[int]
    image_size: Mapped[JsonArray]
    corners: Mapped[JsonArray]
    corner_ids: Mapped[JsonArray]
    sharpness: Mapped[JsonObject]
    parity_separation: Mapped[float]
    contrast: Mapped[float]
    # Null in captures that are older than its measurement.
    saturated_share: Mapped[float | None] = mapped_column(default=None)


class CaptureRow(SeenPicture, Row):
    """One accepted image of a run and what was seen in it; the image is in the blob store under `sha256`.

    fixture: where the target stood, of a picture that is to say where the camera is in the vehicle.
    """

    __tablename__ = "capture"
    __table_args__ = (
        UniqueConstraint("run_id", "number"),
        UniqueConstraint("run_id", "sha256"),
        CheckConstraint("number >= 1", name="number_from_1"),
        CheckConstraint("length(sha256) = 64", name="sha256_is_hex"),
        CheckConstraint("role <> 'extrinsics' OR fixture IS NOT NULL", name="extrinsics_has_fixture"),
        Index(None, "sha256"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    run_id: Mapped[UUID] = mapped_column(refers_to("run.id"))
    role: Mapped[CaptureRole] = mapped_column(
        word(CaptureRole, "role"),
        default=CaptureRole.INTRINSICS,
        server_default=CaptureRole.INTRINSICS.value,
    )
    fixture: Mapped[JsonObject | None] = mapped_column(default=None)
    pose_index: Mapped[int | None] = mapped_column(default=None)
    pose: Mapped[JsonObject | None] = mapped_column(default=None)
    match_error_px: Mapped[float | None] = mapped_column(default=None)
    created_at: Mapped[datetime]


class CalibrationRow(Row):
    """The result of a run; `document` is everything that was reported, and enough to recompute it."""

    __tablename__ = "calibration"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    run_id: Mapped[UUID] = mapped_column(refers_to("run.id"), unique=True)
    verdict: Mapped[Verdict] = mapped_column(word(Verdict, "verdict"))
    lens: Mapped[str]
    intrinsics: Mapped[JsonObject]
    covariance: Mapped[JsonArray]
    rms_px: Mapped[float]
    sigma_px: Mapped[float]
    document: Mapped[JsonObject]
    versions: Mapped[JsonObject]
    created_at: Mapped[datetime]


class MeasurementRow(Row):
    """One gate's value of a calibration against its limit; null where it is not known or has no limit."""

    __tablename__ = "measurement"
    __table_args__ = (
        CheckConstraint("comparison IN ('<=', '>=', '==')", name="comparison"),
        Index(None, "calibration_id"),
        Index(None, "gate", "name"),
    )

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    calibration_id: Mapped[UUID] = mapped_column(refers_to("calibration.id"))
    gate: Mapped[str]
    name: Mapped[str]
    value: Mapped[float | None]
    unit: Mapped[str]
    limit: Mapped[float | None]
    comparison: Mapped[str]
    margin: Mapped[float | None]
    verdict: Mapped[Verdict] = mapped_column(word(Verdict, "verdict"))
    advice: Mapped[str]
    # Both null in results that are older than codes; facts also where there are none.
    reason: Mapped[str | None] = mapped_column(default=None)
    facts: Mapped[JsonObject | None] = mapped_column(default=None)


class SignedDocument(MappedAsDataclass, kw_only=True, eq=False, repr=False):
    """What a row holds of a signed document; rows are only ever added. token: the compact JWS."""

    key_id: Mapped[str]
    token: Mapped[str]
    created_at: Mapped[datetime]


class CertificateRow(SignedDocument, Row):
    """The signed certificate of a finished run."""

    __tablename__ = "certificate"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    run_id: Mapped[UUID] = mapped_column(refers_to("run.id"), unique=True)


class ApiKeyRow(Row):
    """A key that may call the API; only its hash is kept."""

    __tablename__ = "api_key"

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    name: Mapped[str]
    role: Mapped[Role] = mapped_column(word(Role, "role"))
    prefix: Mapped[str]
    sha256: Mapped[str] = mapped_column(unique=True)
    created_at: Mapped[datetime]
    last_used_at: Mapped[datetime | None] = mapped_column(default=None)
    revoked_at: Mapped[datetime | None] = mapped_column(default=None)


class IdempotencyKeyRow(Row):
    """What was answered to a request that may come again; `fingerprint` tells another one under its key."""

    __tablename__ = "idempotency_key"
    __table_args__ = (Index(None, "created_at"),)

    key: Mapped[str] = mapped_column(primary_key=True)
    principal: Mapped[str] = mapped_column(primary_key=True)
    fingerprint: Mapped[str]
    status: Mapped[int | None] = mapped_column(default=None)
    body: Mapped[JsonObject | None] = mapped_column(default=None)
    created_at: Mapped[datetime]


class OutboxEventRow(Row):
    """Something that leaves the service, written in the transaction that made it true."""

    __tablename__ = "outbox_event"
    __table_args__ = (Index(None, "claimed_at", "created_at", "id"),)

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    kind: Mapped[str]
    subject: Mapped[str]
    body: Mapped[JsonObject]
    created_at: Mapped[datetime]
    claimed_at: Mapped[datetime | None] = mapped_column(default=None)


class AuditEntryRow(Row):
    """Who did what, when; rows are only ever added."""

    __tablename__ = "audit_entry"
    __table_args__ = (Index(None, "at", "id"), Index(None, "subject", "at"))

    id: Mapped[UUID] = mapped_column(primary_key=True, default_factory=new_id)
    at: Mapped[datetime]
    who: Mapped[str]
    action: Mapped[str]
    subject: Mapped[str]
    facts: Mapped[JsonObject]
