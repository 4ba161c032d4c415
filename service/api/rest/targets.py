"""Targets: the physical boards of a plant, known by the serial on their back; patterns to print or show."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Query, Response
from pydantic import ConfigDict, Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, PageOf, ReadDb
from service.api.rest.board_shapes import BoardShape, Drift, TargetName
from service.api.shapes import Answer, Page, Request
from service.usecases import board_shapes, sheets, targets
from service.usecases.text import Label

router = APIRouter(prefix="/targets", tags=["Targets"])

Spec = Annotated[
    str,
    Query(max_length=60, description="Words that name a target.", examples=["chessboard:9x6:25mm"]),
]
Point = tuple[float, float]


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


class TargetPattern(Answer):
    """What is dark of a target, m: x along the rows of features from the first one, y from row to row."""

    spec: str
    name: str = Field(description="What messages call it.")
    square_m: float = Field(description="The side of a square; of circles the grid's step.")
    step_m: float | None = Field(
        description="Features lie at whole multiples of it; null where there is no such step."
    )
    corner_m: Point = Field(description="Top left of the rectangle around all that is dark.")
    size_m: Point = Field(description="Width and height of that rectangle.")
    quiet_m: float = Field(description="What must stay white around the rectangle.")
    loops: list[list[Point]] = Field(description="Borders of the dark areas, by the even-odd rule.")
    discs: list[tuple[float, float, float]] = Field(description="Dark discs: centre and radius.")


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


@router.get("/pattern", summary="Read a target's pattern")
def read_pattern(spec: Spec, caller: Viewer) -> TargetPattern:
    """Read what is dark of a target, to draw it: on a screen, in a report, for a plotter."""
    view = sheets.read_pattern(spec)
    pattern = view.pattern
    return TargetPattern.model_validate(
        {
            "spec": view.spec,
            "name": view.name,
            "square_m": view.square_m,
            "step_m": pattern.step_m,
            "corner_m": pattern.corner.tolist(),
            "size_m": pattern.size.tolist(),
            "quiet_m": pattern.quiet_m,
            "loops": [loop.tolist() for loop in pattern.loops],
            "discs": pattern.discs.tolist(),
        }
    )


@router.get(
    "/sheet",
    summary="Get a target's sheet to print",
    response_class=Response,
    responses={200: {"content": {"application/pdf": {}, "image/svg+xml": {}}, "description": "The sheet."}},
)
def read_sheet(
    spec: Spec,
    caller: Viewer,
    file_format: Annotated[
        sheets.SheetFormat, Query(alias="format", description="What to write the sheet as.")
    ] = "pdf",
    paper: Annotated[
        str,
        Query(
            max_length=20,
            description="`auto` for the smallest of A4 to A0 that the target fits on, one of them, or a size "
            "such as `700x500mm`.",
        ),
    ] = sheets.SMALLEST_THAT_FITS,
) -> Response:
    """Get a target at true scale, with two rulers to check the print. Print it at 100 %, not fitted."""
    made = sheets.make_sheet(spec, file_format, paper)
    headers = {"Content-Disposition": f'attachment; filename="{made.name}"'}
    return Response(made.content, media_type=made.media_type, headers=headers)


@router.get("/{target}", summary="Read a board")
def read_target(target: TargetName, caller: Viewer, db: ReadDb) -> TargetDetail:
    """Read a board with its certified shape and its drift."""
    return TargetDetail.model_validate(board_shapes.read_target(db, target))
