"""API keys: making, finding and revoking them. A key is 256 random bits; only its SHA-256 is kept.

What a role may do stands with the routes (`service.api.auth`).
"""

import hashlib
import secrets
from dataclasses import dataclass
from datetime import datetime, timedelta
from uuid import UUID

from sqlalchemy import select, update
from sqlalchemy.orm import Session

from service.core.errors import NotAuthenticated, NotFound
from service.storage.database import Database
from service.storage.models import ApiKeyRow
from service.storage.words import Role
from service.usecases.audit import record
from service.usecases.paging import PageRequest, Part, page_of

MARK = "dmscal"
# Noting each use would make every reading request a writing one.
USE_NOTED_EVERY = timedelta(minutes=5)


@dataclass(frozen=True)
class Caller:
    """Who asks, and in which role."""

    id: UUID
    name: str
    role: Role


@dataclass(frozen=True)
class KeyMade:
    """A new key with its secret, the only time that it is known."""

    id: UUID
    name: str
    role: Role
    prefix: str
    created_at: datetime
    key: str
    last_used_at: datetime | None = None
    revoked_at: datetime | None = None


def create_key(session: Session, name: str, role: Role, who: str, now: datetime) -> KeyMade:
    """Make a key and return it with its secret."""
    prefix, secret = secrets.token_hex(4), secrets.token_urlsafe(32)
    key = f"{MARK}_{prefix}_{secret}"
    row = ApiKeyRow(name=name, role=role, prefix=prefix, sha256=_digest(key), created_at=now)
    session.add(row)
    record(session, now, who, "key.create", f"key:{row.id}", name=name, role=role.value)
    return KeyMade(row.id, name, role, prefix, now, key)


def create_first_key(session: Session, now: datetime) -> KeyMade | None:
    """Make an admin's key if there is no key at all, as on the first start; else return None."""
    if session.scalar(select(ApiKeyRow.id).limit(1)) is not None:
        return None
    return create_key(session, "first key", Role.ADMIN, "first start", now)


def identify(database: Database, key: str, now: datetime) -> Caller:
    """Return whose key this is; raises NotAuthenticated for an unknown or revoked one."""
    with database.read() as session:
        row = session.scalar(select(ApiKeyRow).where(ApiKeyRow.sha256 == _digest(key)))
    if row is None or row.revoked_at is not None:
        raise NotAuthenticated(
            "This API key is not known or was revoked. Ask an administrator for a new one."
        )
    if row.last_used_at is None or now - row.last_used_at > USE_NOTED_EVERY:
        with database.write() as session:
            session.execute(update(ApiKeyRow).where(ApiKeyRow.id == row.id).values(last_used_at=now))
    return Caller(row.id, row.name, row.role)


def list_keys(session: Session, page: PageRequest) -> Part[ApiKeyRow]:
    """Return a part of the keys, newest first."""
    return page_of(session, select(ApiKeyRow), ApiKeyRow, page)


def revoke_key(session: Session, key_id: UUID, who: str, now: datetime) -> ApiKeyRow:
    """Revoke a key; a revoked one stays as it is. Raises NotFound."""
    row = session.get(ApiKeyRow, key_id)
    if row is None:
        raise NotFound("There is no API key of this id. List the keys to find it.", key_id=str(key_id))
    if row.revoked_at is None:
        row.revoked_at = now
        record(session, now, who, "key.revoke", f"key:{row.id}", name=row.name)
    return row


def _digest(key: str) -> str:
    # 256 random bits cannot be guessed, so that a fast hash is enough and no salt is needed.
    return hashlib.sha256(key.encode("utf-8", "surrogatepass")).hexdigest()
