"""API keys: who may ask for what. The key itself is shown once, when it is made."""

from datetime import datetime
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field

from service.api.auth import Admin, Viewer
from service.api.dependencies import Db, Now, PageOf, ReadDb
from service.api.shapes import Answer, Id, Page, Request
from service.storage.words import Role
from service.usecases import access
from service.usecases.text import Label

router = APIRouter(prefix="/keys", tags=["API keys"])


class NewKey(Request):
    """A key to make."""

    name: Label = Field(description="Who or what uses the key.")
    role: Role = Field(strict=False)

    model_config = ConfigDict(json_schema_extra={"examples": [{"name": "kiosk line 1", "role": "operator"}]})


class ApiKey(Answer):
    """A key, without its secret."""

    id: UUID
    name: str
    role: Role
    prefix: str = Field(description="The part of the key that may be shown.")
    created_at: datetime
    last_used_at: datetime | None
    revoked_at: datetime | None


class OwnKey(Answer):
    """The key that asks: whose it is, and what it may do."""

    id: UUID
    name: str
    role: Role


class ApiKeyMade(ApiKey):
    """A new key with its secret, which is not stored and cannot be shown again."""

    key: str


@router.post("", status_code=201, summary="Make an API key")
def create_key(body: NewKey, caller: Admin, db: Db, now: Now) -> ApiKeyMade:
    """Make a key. Keep the answer: the secret is shown this once."""
    return ApiKeyMade.model_validate(access.create_key(db, body.name, body.role, caller.name, now))


@router.get("", summary="List the API keys")
def list_keys(caller: Admin, db: ReadDb, page: PageOf) -> Page[ApiKey]:
    """List the keys, newest first, revoked ones too."""
    return Page[ApiKey].model_validate(access.list_keys(db, page))


@router.get("/own", summary="Read the key that asks")
def read_own_key(caller: Viewer) -> OwnKey:
    """Read whose key this is and its role, so that a page offers only what its key may do."""
    return OwnKey.model_validate(caller)


@router.post("/{key_id}/revoke", summary="Revoke an API key")
def revoke_key(key_id: Id, caller: Admin, db: Db, now: Now) -> ApiKey:
    """Revoke a key: it is refused from now on. Revoking it again changes nothing."""
    return ApiKey.model_validate(access.revoke_key(db, key_id, caller.name, now))
