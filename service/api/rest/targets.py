"""Targets: the physical boards of a plant, known by the serial on their back."""

from datetime import datetime
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, PageOf, ReadDb
from service.api.shapes import Answer, Page, Request
from service.usecases import targets
from service.usecases.text import Label

router = APIRouter(prefix="/targets", tags=["Targets"])


class NewTarget(Request):
    """A board to register."""

    serial: Label | None = Field(default=None, description="What is written on the board.")
    spec: str = Field(max_length=60, description="Pattern with inner corners and the side of a square.")

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"serial": "BOARD-0001", "spec": "chessboard:9x6:25mm"}]}
    )


class Target(Answer):
    """A board."""

    id: UUID
    serial: str | None
    spec: str
    created_at: datetime


@router.post("", status_code=201, summary="Register a board")
def create_target(body: NewTarget, caller: Engineer, db: Db, now: Now) -> Target:
    """Register a physical board. Its pattern must be one that the service can detect."""
    return Target.model_validate(targets.create_target(db, body.serial, body.spec, caller.name, now))


@router.get("", summary="List the boards")
def list_targets(caller: Viewer, db: ReadDb, page: PageOf) -> Page[Target]:
    """List the boards, newest first."""
    return Page[Target].model_validate(targets.list_targets(db, page))
