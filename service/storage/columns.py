"""Column types that mean the same on SQLite and PostgreSQL: ids, UTC times, JSON, words of a closed set."""

import json
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any
from uuid import UUID

from sqlalchemy import JSON, DateTime, Dialect, Enum
from sqlalchemy.types import TypeDecorator
from uuid_utils.compat import uuid7

Json = JSON(none_as_null=True)
"""JSON as text on both engines: PostgreSQL's JSONB would turn −0.0 into 0, and recomputing must be exact."""


def new_id() -> UUID:
    """Return a UUIDv7: unique, and later ids of one process sort after earlier ones."""
    return uuid7()


class UtcDateTime(TypeDecorator[datetime]):
    """An aware time, kept in UTC; refuses naive ones."""

    impl = DateTime(timezone=True)
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """Turn a time into UTC; SQLite compares times as text, so there the zone is left out."""
        if value is None:
            return None
        if value.tzinfo is None:
            raise ValueError("a time needs its zone: take it from the clock")
        utc = value.astimezone(UTC)
        return utc.replace(tzinfo=None) if dialect.name == "sqlite" else utc

    def process_result_value(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """Return the time, aware and in UTC."""
        if value is None:
            return None
        return value.replace(tzinfo=UTC) if dialect.name == "sqlite" else value.astimezone(UTC)


def word(kind: type[StrEnum], constraint: str) -> Enum:
    """Return a column type for a StrEnum, kept by value and held by a CHECK named `constraint`."""
    return Enum(
        kind,
        name=constraint,
        native_enum=False,
        create_constraint=True,
        length=16,
        values_callable=lambda words: [member.value for member in words],
    )


def to_json(value: Any) -> str:
    """Return `value` as JSON, floats with all their digits; raises ValueError for NaN and infinities.

    They are no JSON and PostgreSQL refuses them: what is not known is null.
    """
    return json.dumps(value, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
