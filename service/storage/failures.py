"""What the database refuses, as errors of the domain: violated constraints by name, and busy, full or away.

A refusal that is not listed here is a fault of the service and stays the driver's own error.
"""

import re
import sqlite3
from collections.abc import Mapping

import psycopg
from sqlalchemy import Engine, ExceptionContext, MetaData, UniqueConstraint, event

from service.core.errors import (
    AlreadyExists,
    Conflict,
    DatabaseBusy,
    DatabaseUnreachable,
    DiskFull,
    DuplicateImage,
    RunAlreadyFinished,
    ServiceError,
)
from service.storage.tables import ALL_TABLES

CONSTRAINT_TO_ERROR: Mapping[str, tuple[type[Conflict], str]] = {
    "uq_target_serial": (
        AlreadyExists,
        "There is a target with this serial. Use it, or another serial.",
    ),
    "uq_sku_code": (
        AlreadyExists,
        "There is a SKU with this code. Add a revision, or choose another code.",
    ),
    "uq_sku_revision_sku_id_number": (
        AlreadyExists,
        "Someone added this revision just now. Send yours again.",
    ),
    "uq_station_code": (AlreadyExists, "There is a station with this code. Choose another code."),
    "uq_board_shape_target_id_version": (
        AlreadyExists,
        "Another shape of this board was learnt just now. Learn again if you need a newer one.",
    ),
    "uq_capture_run_id_sha256": (DuplicateImage, "The run already holds this very image. Take another one."),
    "uq_capture_run_id_number": (
        AlreadyExists,
        "Another image came at the same time. Send yours again.",
    ),
    "uq_calibration_run_id": (
        RunAlreadyFinished,
        "The run is finished; its result stands. Read the result.",
    ),
    "pk_idempotency_key": (AlreadyExists, "The same request is being carried out. Ask again in a moment."),
}

SQLITE_CODES: Mapping[int, type[ServiceError]] = {
    sqlite3.SQLITE_BUSY: DatabaseBusy,
    sqlite3.SQLITE_LOCKED: DatabaseBusy,
    sqlite3.SQLITE_FULL: DiskFull,
    sqlite3.SQLITE_IOERR: DatabaseUnreachable,
    sqlite3.SQLITE_CANTOPEN: DatabaseUnreachable,
    sqlite3.SQLITE_NOTADB: DatabaseUnreachable,
    sqlite3.SQLITE_CORRUPT: DatabaseUnreachable,
}

SQLSTATES: Mapping[str, type[ServiceError]] = {
    "53100": DiskFull,
    "53200": DatabaseBusy,
    "53300": DatabaseBusy,
    "55P03": DatabaseBusy,
    "57014": DatabaseBusy,
    "40001": DatabaseBusy,
    "40P01": DatabaseBusy,
    "57P01": DatabaseUnreachable,
    "57P02": DatabaseUnreachable,
    "57P03": DatabaseUnreachable,
    "25P03": DatabaseUnreachable,
}

DETAILS: Mapping[type[ServiceError], str] = {
    DatabaseBusy: "The database is busy with other work. Nothing was stored; try again.",
    DatabaseUnreachable: "The database cannot be reached. Have it checked, then send the same request again.",
    DiskFull: "The database has no room left. Nothing was stored; free some space, then try again.",
}


def raise_domain_errors(engine: Engine) -> None:
    """Make `engine` raise errors of the domain where the database refuses for a known reason."""

    @event.listens_for(engine, "handle_error")
    def translate(context: ExceptionContext) -> None:
        error = domain_error(context.original_exception)
        if error is not None:
            raise error from context.original_exception


def domain_error(refusal: BaseException) -> ServiceError | None:
    """Return what a driver's error means to the caller, or None where it is a fault of the service."""
    name = _violated_constraint(refusal)
    if name in CONSTRAINT_TO_ERROR:
        kind, detail = CONSTRAINT_TO_ERROR[name]
        return kind(detail)
    away = _availability(refusal)
    return None if away is None else away(DETAILS[away])


def _availability(refusal: BaseException) -> type[ServiceError] | None:
    if isinstance(refusal, sqlite3.Error):
        # The extended code holds the primary one in its low byte.
        return SQLITE_CODES.get(getattr(refusal, "sqlite_errorcode", 0) & 0xFF)
    if isinstance(refusal, psycopg.OperationalError):
        return SQLSTATES.get(refusal.sqlstate or "", DatabaseUnreachable)
    return None


def _violated_constraint(refusal: BaseException) -> str:
    if isinstance(refusal, psycopg.IntegrityError):
        return refusal.diag.constraint_name or ""
    if isinstance(refusal, sqlite3.IntegrityError):
        return _name_in_message(str(refusal))
    return ""


def _name_in_message(message: str) -> str:
    # SQLite names the columns of a violated key, never the key itself.
    match = re.fullmatch(r"UNIQUE constraint failed: (.+)", message)
    return _names_by_columns(ALL_TABLES).get(match[1], "") if match else ""


def _names_by_columns(metadata: MetaData) -> dict[str, str]:
    keys = [
        key
        for table in metadata.sorted_tables
        for key in table.constraints
        if isinstance(key, UniqueConstraint) or key is table.primary_key
    ]
    return {", ".join(f"{c.table.name}.{c.name}" for c in key.columns): str(key.name) for key in keys}
