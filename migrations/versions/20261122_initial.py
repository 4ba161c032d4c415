"""The tables of the first release.

Revision 5d0c1b7e4a21, the first one, 2026-11-22 07:29 UTC.
"""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "5d0c1b7e4a21"
down_revision: str | Sequence[str] | None = None
branch_labels: str | Sequence[str] | None = None
depends_on: str | Sequence[str] | None = None


def words(name: str, *values: str) -> sa.Enum:
    return sa.Enum(*values, name=name, native_enum=False, create_constraint=True, length=16)


def refers(column: str, other: str, name: str) -> sa.ForeignKeyConstraint:
    return sa.ForeignKeyConstraint([column], [other], name=op.f(name), initially="DEFERRED", deferrable=True)


def upgrade() -> None:
    op.create_table(
        "api_key",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("role", words("role", "viewer", "mes", "operator", "engineer", "admin"), nullable=False),
        sa.Column("prefix", sa.String(), nullable=False),
        sa.Column("sha256", sa.String(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("last_used_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("revoked_at", sa.DateTime(timezone=True), nullable=True),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_api_key")),
        sa.UniqueConstraint("sha256", name=op.f("uq_api_key_sha256")),
    )
    op.create_table(
        "audit_entry",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("who", sa.String(), nullable=False),
        sa.Column("action", sa.String(), nullable=False),
        sa.Column("subject", sa.String(), nullable=False),
        sa.Column("facts", sa.JSON(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_audit_entry")),
    )
    op.create_index(op.f("ix_audit_entry_at_id"), "audit_entry", ["at", "id"])
    op.create_index(op.f("ix_audit_entry_subject_at"), "audit_entry", ["subject", "at"])
    op.create_table(
        "idempotency_key",
        sa.Column("key", sa.String(), nullable=False),
        sa.Column("principal", sa.String(), nullable=False),
        sa.Column("fingerprint", sa.String(), nullable=False),
        sa.Column("status", sa.Integer(), nullable=True),
        sa.Column("body", sa.JSON(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("key", "principal", name=op.f("pk_idempotency_key")),
    )
    op.create_index(op.f("ix_idempotency_key_created_at"), "idempotency_key", ["created_at"])
    op.create_table(
        "job",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("kind", sa.String(), nullable=False),
        sa.Column(
            "state", words("state", "queued", "running", "done", "failed", "cancelled"), nullable=False
        ),
        sa.Column("progress", sa.Double(), nullable=False),
        sa.Column("arguments", sa.JSON(), nullable=False),
        sa.Column("result", sa.JSON(), nullable=True),
        sa.Column("problem", sa.JSON(), nullable=True),
        sa.Column("attempts", sa.Integer(), nullable=False),
        sa.Column("claimed_by", sa.Uuid(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("started_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("heartbeat_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("finished_at", sa.DateTime(timezone=True), nullable=True),
        sa.CheckConstraint(
            "state <> 'running' OR claimed_by IS NOT NULL", name=op.f("ck_job_running_is_claimed")
        ),
        sa.CheckConstraint("progress BETWEEN 0 AND 1", name=op.f("ck_job_progress_is_share")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_job")),
    )
    op.create_index(op.f("ix_job_state_created_at"), "job", ["state", "created_at"])
    op.create_table(
        "outbox_event",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("kind", sa.String(), nullable=False),
        sa.Column("subject", sa.String(), nullable=False),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("claimed_at", sa.DateTime(timezone=True), nullable=True),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_outbox_event")),
    )
    op.create_index(
        op.f("ix_outbox_event_claimed_at_created_at_id"), "outbox_event", ["claimed_at", "created_at", "id"]
    )
    op.create_table(
        "sku",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("code", sa.String(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_sku")),
        sa.UniqueConstraint("code", name=op.f("uq_sku_code")),
    )
    op.create_table(
        "target",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("serial", sa.String(), nullable=True),
        sa.Column("spec", sa.String(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_target")),
        sa.UniqueConstraint("serial", name=op.f("uq_target_serial")),
    )
    op.create_table(
        "sku_revision",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("sku_id", sa.Uuid(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("document", sa.JSON(), nullable=False),
        sa.Column("state", words("state", "draft", "published", "retired"), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("published_at", sa.DateTime(timezone=True), nullable=True),
        sa.CheckConstraint(
            "state <> 'published' OR published_at IS NOT NULL",
            name=op.f("ck_sku_revision_published_has_time"),
        ),
        sa.CheckConstraint("number >= 1", name=op.f("ck_sku_revision_number_from_1")),
        refers("sku_id", "sku.id", "fk_sku_revision_sku_id_sku"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_sku_revision")),
        sa.UniqueConstraint("sku_id", "number", name=op.f("uq_sku_revision_sku_id_number")),
    )
    op.create_table(
        "station",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("code", sa.String(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("target_id", sa.Uuid(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        refers("target_id", "target.id", "fk_station_target_id_target"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_station")),
        sa.UniqueConstraint("code", name=op.f("uq_station_code")),
    )
    op.create_table(
        "pose_set",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("sku_revision_id", sa.Uuid(), nullable=False),
        sa.Column("state", words("state", "draft", "published", "retired"), nullable=False),
        sa.Column("poses", sa.JSON(), nullable=False),
        sa.Column("prediction", sa.JSON(), nullable=False),
        sa.Column("provenance", sa.JSON(), nullable=False),
        sa.Column("job_id", sa.Uuid(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("published_at", sa.DateTime(timezone=True), nullable=True),
        sa.CheckConstraint(
            "state <> 'published' OR published_at IS NOT NULL", name=op.f("ck_pose_set_published_has_time")
        ),
        refers("job_id", "job.id", "fk_pose_set_job_id_job"),
        refers("sku_revision_id", "sku_revision.id", "fk_pose_set_sku_revision_id_sku_revision"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_pose_set")),
    )
    op.create_index(op.f("ix_pose_set_sku_revision_id_state"), "pose_set", ["sku_revision_id", "state"])
    op.create_table(
        "run",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("sku_revision_id", sa.Uuid(), nullable=False),
        sa.Column("pose_set_id", sa.Uuid(), nullable=True),
        sa.Column("station_id", sa.Uuid(), nullable=True),
        sa.Column("serial", sa.String(), nullable=False),
        sa.Column(
            "purpose",
            words("purpose", "production", "retest", "golden", "study", "trial", "simulated"),
            nullable=False,
        ),
        sa.Column("state", words("state", "open", "finished", "aborted"), nullable=False),
        sa.Column("verdict", words("verdict", "PASS", "MARGINAL", "FAIL"), nullable=True),
        sa.Column("outcome", words("outcome", "COMPLETED", "ERROR", "ABORTED", "TIMEOUT"), nullable=True),
        sa.Column("created_by", sa.String(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("finished_at", sa.DateTime(timezone=True), nullable=True),
        sa.CheckConstraint(
            "(state = 'finished') = (verdict IS NOT NULL)", name=op.f("ck_run_finished_has_verdict")
        ),
        sa.CheckConstraint("(state = 'open') = (finished_at IS NULL)", name=op.f("ck_run_ended_has_time")),
        refers("pose_set_id", "pose_set.id", "fk_run_pose_set_id_pose_set"),
        refers("sku_revision_id", "sku_revision.id", "fk_run_sku_revision_id_sku_revision"),
        refers("station_id", "station.id", "fk_run_station_id_station"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_run")),
    )
    op.create_index(op.f("ix_run_created_at_id"), "run", ["created_at", "id"])
    op.create_index(op.f("ix_run_serial_created_at_id"), "run", ["serial", "created_at", "id"])
    op.create_table(
        "calibration",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("run_id", sa.Uuid(), nullable=False),
        sa.Column("verdict", words("verdict", "PASS", "MARGINAL", "FAIL"), nullable=False),
        sa.Column("lens", sa.String(), nullable=False),
        sa.Column("intrinsics", sa.JSON(), nullable=False),
        sa.Column("covariance", sa.JSON(), nullable=False),
        sa.Column("rms_px", sa.Double(), nullable=False),
        sa.Column("sigma_px", sa.Double(), nullable=False),
        sa.Column("document", sa.JSON(), nullable=False),
        sa.Column("versions", sa.JSON(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        refers("run_id", "run.id", "fk_calibration_run_id_run"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_calibration")),
        sa.UniqueConstraint("run_id", name=op.f("uq_calibration_run_id")),
    )
    op.create_table(
        "capture",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("run_id", sa.Uuid(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("pose_index", sa.Integer(), nullable=True),
        sa.Column("file_name", sa.String(), nullable=False),
        sa.Column("sha256", sa.String(), nullable=False),
        sa.Column("media_type", sa.String(), nullable=False),
        sa.Column("bytes", sa.Integer(), nullable=False),
        sa.Column("image_size", sa.JSON(), nullable=False),
        sa.Column("corners", sa.JSON(), nullable=False),
        sa.Column("corner_ids", sa.JSON(), nullable=False),
        sa.Column("sharpness", sa.JSON(), nullable=False),
        sa.Column("parity_separation", sa.Double(), nullable=False),
        sa.Column("contrast", sa.Double(), nullable=False),
        sa.Column("pose", sa.JSON(), nullable=True),
        sa.Column("match_error_px", sa.Double(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.CheckConstraint("length(sha256) = 64", name=op.f("ck_capture_sha256_is_hex")),
        sa.CheckConstraint("number >= 1", name=op.f("ck_capture_number_from_1")),
        refers("run_id", "run.id", "fk_capture_run_id_run"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_capture")),
        sa.UniqueConstraint("run_id", "number", name=op.f("uq_capture_run_id_number")),
        sa.UniqueConstraint("run_id", "sha256", name=op.f("uq_capture_run_id_sha256")),
    )
    op.create_index(op.f("ix_capture_sha256"), "capture", ["sha256"])
    op.create_table(
        "measurement",
        sa.Column("id", sa.Uuid(), nullable=False),
        sa.Column("calibration_id", sa.Uuid(), nullable=False),
        sa.Column("gate", sa.String(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("value", sa.Double(), nullable=True),
        sa.Column("unit", sa.String(), nullable=False),
        sa.Column("limit", sa.Double(), nullable=True),
        sa.Column("comparison", sa.String(), nullable=False),
        sa.Column("margin", sa.Double(), nullable=True),
        sa.Column("verdict", words("verdict", "PASS", "MARGINAL", "FAIL"), nullable=False),
        sa.Column("advice", sa.String(), nullable=False),
        sa.CheckConstraint("comparison IN ('<=', '>=', '==')", name=op.f("ck_measurement_comparison")),
        refers("calibration_id", "calibration.id", "fk_measurement_calibration_id_calibration"),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_measurement")),
    )
    op.create_index(op.f("ix_measurement_calibration_id"), "measurement", ["calibration_id"])
    op.create_index(op.f("ix_measurement_gate_name"), "measurement", ["gate", "name"])


def downgrade() -> None:
    op.drop_table("measurement")
    op.drop_table("capture")
    op.drop_table("calibration")
    op.drop_table("run")
    op.drop_table("pose_set")
    op.drop_table("station")
    op.drop_table("sku_revision")
    op.drop_table("target")
    op.drop_table("sku")
    op.drop_table("outbox_event")
    op.drop_table("job")
    op.drop_table("idempotency_key")
    op.drop_table("audit_entry")
    op.drop_table("api_key")
