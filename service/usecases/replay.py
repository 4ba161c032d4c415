"""Remembers answers by Idempotency-Key, in the transaction of the request that they answer."""

import hashlib
from datetime import datetime
from typing import Any

from sqlalchemy.orm import Session

from service.core.errors import IdempotencyKeyReused
from service.storage.models import IdempotencyKeyRow

JsonObject = dict[str, Any]


def fingerprint(*parts: str) -> str:
    """Return what tells one request from another."""
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def recall(session: Session, key: str, principal: str, request: str) -> tuple[int, JsonObject] | None:
    """Return status and body of the answer that was given under this key, or None.

    Raises IdempotencyKeyReused when the key came with another request.
    """
    row = session.get(IdempotencyKeyRow, (key, principal))
    if row is None:
        return None
    if row.fingerprint != request or row.status is None or row.body is None:
        raise IdempotencyKeyReused(
            "This Idempotency-Key was used for another request. Take a new key for a new request, and "
            "send exactly "
            "the same request to repeat one.",
            key=key,
        )
    return row.status, row.body


def remember(
    session: Session, key: str, principal: str, *, request: str, status: int, body: JsonObject, now: datetime
) -> None:
    """Store the answer that is about to be given."""
    session.add(
        IdempotencyKeyRow(
            key=key, principal=principal, fingerprint=request, status=status, body=body, created_at=now
        )
    )
