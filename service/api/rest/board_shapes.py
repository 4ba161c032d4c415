"""Shapes of boards: learnt from the runs of their stations, certified, watched."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Path
from pydantic import ConfigDict, Field

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, Of, PageOf, ReadDb
from service.api.rest.jobs import Job
from service.api.shapes import Answer, Id, Page, Request
from service.core.quality.board_drift import DriftState
from service.storage.words import ShapeState
from service.usecases import board_shapes
from service.usecases.board_learning import FEWEST_RUNS, USUAL_RUNS

router = APIRouter(tags=["Targets"])

TargetName = Annotated[
    str, Path(max_length=64, description="Serial or id of the board.", examples=["BOARD-0001"])
]


class LearnShape(Request):
    """From how many of the board's last runs to learn."""

    runs: int = Field(default=USUAL_RUNS, ge=FEWEST_RUNS, le=200)

    model_config = ConfigDict(json_schema_extra={"examples": [{"runs": USUAL_RUNS}]})


class Drift(Answer):
    """How far a learnt shape is from the certified one."""

    state: DriftState = Field(description="`near` from 80 % of the limit on, `over` beyond it.")
    worst_mm: float = Field(description="Farthest that a corner has moved.")
    rms_mm: float
    limit_mm: float
    focal_px: float = Field(description="What the focal length is off by with the certified shape.")
    mapping_px: float = Field(description="And the map of the working zone, root of the mean square.")
    measured_at: datetime | None = None


class ShapeCertainty(Answer):
    """Standard deviations that every camera solved with the shape has in common; more runs make them less."""

    corner_mm: float = Field(description="Of the corners themselves, root of the mean square.")
    focal_px: float
    centre_px: float
    mapping_px: float = Field(description="Of the map of the working zone.")


class BoardShape(Answer):
    """Where the corners of a board are, against its pattern; learnt from runs."""

    id: UUID
    target_id: UUID
    version: int
    state: ShapeState
    runs: int = Field(description="From how many it was learnt.")
    bend_mm: float = Field(description="Height, peak to peak.")
    in_plane_mm: float = Field(description="Farthest that a corner is from its place within the plane.")
    certainty: ShapeCertainty
    sigma_flat_px: float = Field(description="Noise of the corners when the board is taken for flat.")
    sigma_px: float = Field(description="Noise of the corners with this shape.")
    drift: Drift | None = Field(description="From the shape that was certified when it was learnt.")
    created_at: datetime
    created_by: str
    certified_at: datetime | None = Field(description="From when on solves use it.")
    certified_by: str | None
    retired_at: datetime | None
    retired_by: str | None


class BoardShapeDetail(BoardShape):
    """A shape with its corners in the order of the pattern, x y z, and the runs behind it."""

    corners_mm: list[tuple[float, float]] = Field(description="Where the pattern has them, x y.")
    deviations_mm: list[tuple[float, float, float]] = Field(
        description="From there; z points away from who looks at the board."
    )
    sd_mm: list[tuple[float, float, float]]
    run_ids: list[UUID]


@router.post("/targets/{target}/shape", status_code=202, summary="Learn the shape of a board")
def learn_shape(target: TargetName, body: LearnShape, *, caller: Engineer, db: Db, of: Of, now: Now) -> Job:
    """Learn where the corners of a board really are, from its last runs, in the background.

    The job's result names the shape, a draft. Certify it to have it used. Runs teach that were finished at
    a station with this board and found their corners well, whether or not the board's bend made them fail.
    """
    return Job.model_validate(
        board_shapes.request_shape(db, of.jobs, target, body.runs, who=caller.name, now=now)
    )


@router.get("/targets/{target}/shapes", summary="List the shapes of a board")
def list_shapes(target: TargetName, caller: Viewer, db: ReadDb, page: PageOf) -> Page[BoardShape]:
    """List the shapes of a board, newest first."""
    return Page[BoardShape].model_validate(board_shapes.list_shapes(db, target, page))


@router.get("/board-shapes/{shape_id}", summary="Read the shape of a board")
def read_shape(shape_id: Id, caller: Viewer, db: ReadDb) -> BoardShapeDetail:
    """Read a shape with its corners."""
    return BoardShapeDetail.model_validate(board_shapes.read_shape(db, shape_id))


@router.post("/board-shapes/{shape_id}/certify", summary="Certify the shape of a board")
def certify_shape(shape_id: Id, caller: Engineer, db: Db, now: Now) -> BoardShapeDetail:
    """Have runs at this board's stations solved with the shape from now on; the one before is retired."""
    return BoardShapeDetail.model_validate(board_shapes.certify_shape(db, shape_id, caller.name, now))


@router.post("/board-shapes/{shape_id}/retire", summary="Retire the shape of a board")
def retire_shape(shape_id: Id, caller: Engineer, db: Db, now: Now) -> BoardShapeDetail:
    """Take a shape out of use. Without a certified one the board is taken for flat again."""
    return BoardShapeDetail.model_validate(board_shapes.retire_shape(db, shape_id, caller.name, now))
