"""Pose sets: the ordered poses that an operator is asked for.

Planned by a job or imported, then published.
"""

from datetime import datetime
from typing import Annotated, Any, Self
from uuid import UUID

from fastapi import APIRouter, Response
from pydantic import ConfigDict, Field, model_validator

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, Of, PageOf, ReadDb
from service.api.rest.jobs import Job
from service.api.shapes import Answer, Id, Page, Request, RevisionNumber, SkuCode
from service.core.planning.criterion import Objective, Weights
from service.core.planning.robustness import DRAWS
from service.storage.words import Publication
from service.usecases import pose_sets
from service.usecases.planning import Planner, PlanRequest

router = APIRouter(tags=["Pose sets"])

Coordinate = Annotated[float, Field(ge=-100, le=100)]
Vector3 = Annotated[tuple[Coordinate, Coordinate, Coordinate], Field(strict=False)]


class PoseShape(Request):
    """A pose of the board in the camera's frame (`T_cam_board`): rotation vector, rad, and translation, m."""

    rvec: Vector3
    tvec: Vector3


class WeightsShape(Request):
    """How much each aim counts, in units of what an average set reaches; not all zero."""

    parameters: Annotated[float, Field(ge=0, le=1000)] = 0.0
    mapping_mean: Annotated[float, Field(ge=0, le=1000)] = 0.0
    mapping_worst: Annotated[float, Field(ge=0, le=1000)] = 0.0

    @model_validator(mode="after")
    def _one_counts(self) -> Self:
        if not any((self.parameters, self.mapping_mean, self.mapping_worst)):
            raise ValueError("at least one weight must be greater than 0")
        return self


class NewPoseSet(Request):
    """How to plan, or the poses themselves: without any field the service plans with its defaults."""

    seed: int = Field(default=0, ge=0, le=2**31 - 1, description="Same seed, same poses.")
    candidates: int = Field(default=3000, ge=100, le=20000, description="Poses to choose from.")
    objective: Objective = Field(
        default="balanced",
        description="What to make small: the paper's parameter norm, the mapping error (mean and worst, or "
        "worst alone), or norm and mean.",
    )
    weights: WeightsShape | None = Field(
        default=None, description="A mix of your own instead of an objective."
    )
    draws: int = Field(
        default=DRAWS,
        ge=1,
        le=32,
        description="Cameras within the SKU's tolerance, and hands, that judge the set; 1: the nominal only.",
    )
    planner: Planner = Field(
        default="exchange", description="`paper`: the paper's own procedure, as a baseline to compare with."
    )
    poses: list[PoseShape] | None = Field(
        default=None, min_length=3, max_length=100, description="Import these poses instead of planning."
    )

    model_config = ConfigDict(json_schema_extra={"examples": [{"seed": 1, "candidates": 3000}]})

    @model_validator(mode="after")
    def _plans_or_imports(self) -> Self:
        planned_by = self.model_fields_set - {"poses"}
        if self.poses is not None and planned_by:
            raise ValueError(f"give either poses to import, or {', '.join(sorted(planned_by))} to plan")
        if self.weights is not None and "objective" in self.model_fields_set:
            raise ValueError("give either an objective or weights")
        return self


class PlannedPose(Answer):
    """A pose to take, and where the four outermost corners of the board lie in the image then."""

    rvec: tuple[float, float, float]
    tvec: tuple[float, float, float]
    outer_corners: list[tuple[float, float]] = Field(
        description="tl, tr, br, bl in the board's own order, px."
    )


class PoseSetSku(Answer):
    """Which revision of which SKU."""

    code: str
    revision: int


class PredictedMapping(Answer):
    """Expected error of the mapping from rays to pixels over the planned zone, px.

    Null where the nominal lens does not reach all of the zone: its distortion folds before.
    """

    mean_px: float | None
    worst_px: float | None


class PredictedDiversity(Answer):
    """How much the poses differ: tilts, ratio of distances, share of the image that corners cover."""

    pitch_spread_deg: float
    yaw_spread_deg: float
    distance_ratio: float
    coverage: float


class PredictedCount(Answer):
    """What the best set of so many poses promises."""

    poses: int
    norm_px: float
    mapping_mean_px: float | None
    mapping_worst_px: float | None


class Prediction(Answer):
    """The accuracy that a set promises at the SKU's corner noise, before anybody lifts a board."""

    norm_px: float = Field(description="Expected norm of the parameters' error, the paper's measure.")
    sd: dict[str, float] = Field(description="Expected standard deviation by parameter; 0 for fixed ones.")
    mapping: PredictedMapping
    condition: float
    diversity: PredictedDiversity
    pose_sigma_px: list[float] = Field(default=[], description="Expected corner noise at each pose, px.")
    curve: list[PredictedCount] = Field(default=[], description="What other numbers of poses would promise.")
    required_mapping_px: float | None = Field(
        default=None, description="Mean mapping error that the SKU requires, px."
    )
    smallest_count: int | None = Field(
        default=None, description="Fewest poses that promise it; null where none of the curve does."
    )


class PoseSet(Answer):
    """An ordered set of poses. `poses` is empty as long as the job plans."""

    id: UUID
    sku: PoseSetSku
    state: Publication
    poses: list[PlannedPose]
    prediction: Prediction | None = Field(description="What the set promises; null while it is planned.")
    provenance: dict[str, Any] = Field(description="Where the set comes from, so that it can be made again.")
    job_id: UUID | None
    created_at: datetime
    published_at: datetime | None


class PoseSetSummary(Answer):
    """A pose set in a list: without its poses."""

    id: UUID
    sku: PoseSetSku
    state: Publication
    pose_count: int = Field(description="How many poses; 0 as long as the job plans.")
    prediction: Prediction | None = Field(description="What the set promises; null while it is planned.")
    created_at: datetime
    published_at: datetime | None


class PoseSetRequested(Answer):
    """A pose set, and the job that plans it (null for an imported one)."""

    pose_set: PoseSet
    job: Job | None


@router.post(
    "/skus/{code}/revisions/{number}/pose-sets", status_code=202, summary="Plan or import a pose set"
)
def create_pose_set(
    code: SkuCode,
    number: RevisionNumber,
    body: NewPoseSet,
    *,
    caller: Engineer,
    db: Db,
    of: Of,
    now: Now,
    response: Response,
) -> PoseSetRequested:
    """Plan the best poses for a revision in the background (202: follow the job), or import poses (201)."""
    who = caller.name
    if body.poses is not None:
        response.status_code = 201
        poses = [(pose.rvec, pose.tvec) for pose in body.poses]
        made = pose_sets.import_pose_set(db, code, number, poses, who=who, now=now)
    else:
        weights = None if body.weights is None else Weights(**body.weights.model_dump())
        plan = PlanRequest(
            body.seed,
            body.candidates,
            body.objective,
            weights=weights,
            draws=body.draws,
            planner=body.planner,
        )
        made = pose_sets.request_pose_set(db, of.jobs, code, number, plan, who=who, now=now)
    return PoseSetRequested.model_validate(made)


@router.get("/skus/{code}/pose-sets", summary="List the pose sets of a SKU")
def list_pose_sets(code: SkuCode, caller: Viewer, db: ReadDb, page: PageOf) -> Page[PoseSetSummary]:
    """List the pose sets of all revisions of a camera variant, newest first."""
    return Page[PoseSetSummary].model_validate(pose_sets.list_pose_sets(db, code, page))


@router.get("/pose-sets/{pose_set_id}", summary="Read a pose set")
def read_pose_set(pose_set_id: Id, caller: Viewer, db: ReadDb) -> PoseSet:
    """Read a pose set with its poses and what accuracy it promises."""
    return PoseSet.model_validate(pose_sets.read_pose_set(db, pose_set_id))


@router.post("/pose-sets/{pose_set_id}/publish", summary="Publish a pose set")
def publish_pose_set(pose_set_id: Id, caller: Engineer, db: Db, now: Now) -> PoseSet:
    """Publish a planned set: new runs of its SKU revision follow it, and the set before is retired."""
    return PoseSet.model_validate(pose_sets.publish_pose_set(db, pose_set_id, caller.name, now))
