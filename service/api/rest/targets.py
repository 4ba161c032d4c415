"""Targets: the physical boards of a plant, known by the serial on their back."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, PageOf, ReadDb
from service.api.rest.board_shapes import BoardShape, Drift, TargetName
from service.api.shapes import Answer, Page, Request
from service.usecases import board_shapes, targets
from service.usecases.text import Label

router = APIRouter(prefix="/targets", tags=["Targets"])


class NewTarget(Request):
    """A board to register."""

    serial: Label | None = Field(default=None, description="What is written on the board.")
    spec: str = Field(max_length=60, description="Pattern with inner corners and the side of a square.")
    drift_limit_mm: Annotated[float, Field(gt=0, le=10)] = Field(
        default=targets.DRIFT_LIMIT_MM, description="How far a corner may move from the certified shape."
    )

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"serial": "BOARD-0001", "spec": "chessboard:9x6:25mm"}]}
    )


class Target(Answer):
    """A board."""

    id: UUID
    serial: str | None
    spec: str
    drift_limit_mm: float
    created_at: datetime


class TargetDetail(Target):
    """A board with the shape that solves use, and how far its newest shape is from that."""

    certified_shape: BoardShape | None = Field(description="Null: solves take the board for flat.")
    drift: Drift | None = Field(description="Null: nothing was learnt since the shape was certified.")


@router.post("", status_code=201, summary="Register a board")
def create_target(body: NewTarget, caller: Engineer, db: Db, now: Now) -> Target:
    """Register a physical board. Its pattern must be one that the service can detect."""
    return Target.model_validate(
        targets.create_target(db, body.serial, body.spec, body.drift_limit_mm, who=caller.name, now=now)
    )


@router.get("", summary="List the boards")
def list_targets(caller: Viewer, db: ReadDb, page: PageOf) -> Page[Target]:
    """List the boards, newest first."""
    return Page[Target].model_validate(targets.list_targets(db, page))


@router.get("/{target}", summary="Read a board")
def read_target(target: TargetName, caller: Viewer, db: ReadDb) -> TargetDetail:
    """Read a board with its certified shape and its drift."""
    return TargetDetail.model_validate(board_shapes.read_target(db, target))
