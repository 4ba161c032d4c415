"""Pose sets: the ordered poses that an operator is asked for.

Planned by a job or imported, then published, later retired. Not here: a set explained (`pose_set_review`).
"""

from datetime import datetime
from typing import Annotated, Any, Self
from uuid import UUID

from fastapi import APIRouter, Response
from pydantic import BaseModel, ConfigDict, Field, JsonValue, model_validator

from service.api.auth import Engineer, Viewer
from service.api.dependencies import Db, Now, Of, PageOf, ReadDb
from service.api.rest.jobs import Job
from service.api.shapes import Answer, Id, Page, Request, RevisionNumber, SkuCode
from service.core.planning.criterion import Objective, Weights
from service.core.planning.robustness import DRAWS
from service.storage.words import Publication
from service.usecases import pose_sets, refinement
from service.usecases.planning import Planner, PlanRequest
from service.usecases.pose_set_document import Claim
from service.usecases.sku_document import Pixels
from service.usecases.text import Label

router = APIRouter(tags=["Pose sets"])

Coordinate = Annotated[float, Field(ge=-100, le=100)]
Size = Annotated[tuple[Pixels, Pixels], Field(strict=False)]
OF_A_PLAN = {"seed", "candidates", "objective", "weights", "draws", "planner", "sets"}
OF_AN_IMPORT = {"sku", "revision", "image_size", "target", "prediction", "provenance"}
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


class PoseSetOrigin(BaseModel):
    """How a set was made where it comes from; what else stands there is not kept."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False)

    planner: Label | None = None
    seed: int | None = Field(default=None, ge=0, le=2**63 - 1)
    candidates: int | None = Field(default=None, ge=0, le=2**63 - 1)
    objective: Label | None = None


class NewPoseSet(Request):
    """How to plan, or what to import: without any field the service plans with its defaults.

    To import, give `poses`, or the whole document that an export or `dmscal plan --out` gave: it is refused
    where it names another SKU, image size or target than the revision has.
    """

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
    sets: int = Field(
        default=1000, ge=10, le=10000, description="Random sets that the paper's procedure scores."
    )
    poses: list[PoseShape] | None = Field(
        default=None, min_length=3, max_length=100, description="Import these poses instead of planning."
    )
    sku: Label | None = Field(default=None, description="SKU that the poses were planned for.")
    revision: Annotated[int, Field(ge=1, le=1_000_000)] | None = None
    image_size: Size | None = Field(default=None, description="Image size that they were planned for, px.")
    target: Label | None = Field(default=None, description="Target that they were planned for.")
    prediction: dict[str, JsonValue] | None = Field(
        default=None, description="Of an exported set; worked out anew for this SKU."
    )
    provenance: PoseSetOrigin | None = Field(
        default=None, description="How the set was made where it comes from."
    )

    model_config = ConfigDict(json_schema_extra={"examples": [{"seed": 1, "candidates": 3000}]})

    @model_validator(mode="after")
    def _plans_or_imports(self) -> Self:
        planned_by = self.model_fields_set & OF_A_PLAN
        if self.poses is not None and planned_by:
            raise ValueError(f"give either poses to import, or {', '.join(sorted(planned_by))} to plan")
        if self.weights is not None and "objective" in self.model_fields_set:
            raise ValueError("give either an objective or weights")
        if self.poses is None and self.model_fields_set & OF_AN_IMPORT:
            raise ValueError(
                f"{', '.join(sorted(OF_AN_IMPORT))} belong to poses to import; give the poses too"
            )
        return self

    @property
    def claim(self) -> Claim:
        """For which camera the poses were made, as far as it is said."""
        made = {} if self.provenance is None else self.provenance.model_dump(exclude_none=True)
        return Claim(self.sku, self.revision, self.image_size, self.target, made)


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
    curve: list[PredictedCount] | None = Field(
        default=None, description="What sets of other sizes would promise; null for sets that do not tell."
    )
    required_mapping_px: float | None = Field(
        default=None, description="The mapping error that the planner was to reach."
    )
    smallest_count: int | None = Field(default=None, description="The fewest poses that reach it.")
    pose_sigma_px: list[float] | None = Field(default=None, description="Corner noise expected at each pose.")


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
    published_by: str | None = Field(description="Whose key published it.")
    retired_at: datetime | None = Field(
        description="When it was retired, by hand or by the next publication."
    )
    retired_by: str | None


class PoseSetSummary(Answer):
    """A pose set in a list: without its poses."""

    id: UUID
    sku: PoseSetSku
    state: Publication
    pose_count: int = Field(description="How many poses; 0 as long as the job plans.")
    prediction: Prediction | None = Field(description="What the set promises; null while it is planned.")
    created_at: datetime
    published_at: datetime | None


class ImportablePose(Answer):
    """A pose of the board in the camera's frame (`T_cam_board`): rotation vector, rad, and translation, m."""

    rvec: tuple[float, float, float]
    tvec: tuple[float, float, float]


class PoseSetDocument(Answer):
    """A pose set as `dmscal plan --out` writes it; it can be imported again."""

    sku: str
    revision: int
    image_size: tuple[int, int]
    target: str
    poses: list[ImportablePose]
    prediction: dict[str, Any] = Field(description="What it promises, as the planner told it.")
    provenance: dict[str, Any] = Field(description="How it was made.")


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
        made = pose_sets.import_pose_set(db, code, number, poses, body.claim, who=who, now=now)
    else:
        weights = None if body.weights is None else Weights(**body.weights.model_dump())
        plan = PlanRequest(
            body.seed,
            body.candidates,
            body.objective,
            weights=weights,
            draws=body.draws,
            planner=body.planner,
            sets=body.sets,
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


class Refinement(Request):
    """A finished run whose estimate becomes the nominal of a new revision."""

    run_id: UUID = Field(strict=False)
    seed: int = Field(default=0, ge=0, le=2**31 - 1, description="Of the plan: same seed, same poses.")
    candidates: int = Field(default=3000, ge=100, le=20000, description="Poses to choose from.")

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"run_id": "019b0000-0000-7000-8000-000000000000"}]}
    )


class Refined(Answer):
    """The new revision, a draft, with the set that is planned for it.

    When the job is done, the set's `provenance.follows` says whether the plan before still holds.
    """

    revision: int
    pose_set: PoseSet
    job: Job


@router.post("/skus/{code}/refine", status_code=202, summary="Refine a SKU by a run")
def refine_sku(code: SkuCode, body: Refinement, *, caller: Engineer, db: Db, of: Of, now: Now) -> Refined:
    """Make a revision whose nominal is what a run has found, and plan for it: again until it is settled."""
    plan = PlanRequest(body.seed, body.candidates)
    made = refinement.refine_sku(db, of.jobs, code, body.run_id, plan, who=caller.name, now=now)
    requested = made.requested
    return Refined.model_validate(
        {"revision": made.revision.number, "pose_set": requested.pose_set, "job": requested.job}
    )


@router.post("/pose-sets/{pose_set_id}/retire", summary="Retire a pose set")
def retire_pose_set(pose_set_id: Id, caller: Engineer, db: Db, now: Now) -> PoseSet:
    """Retire the published set: no new run follows it. Open runs keep it; another set may be published."""
    return PoseSet.model_validate(pose_sets.retire_pose_set(db, pose_set_id, caller.name, now))


@router.get("/pose-sets/{pose_set_id}/export", summary="Export a pose set")
def export_pose_set(pose_set_id: Id, caller: Viewer, db: ReadDb, response: Response) -> PoseSetDocument:
    """Give a set as the document that `dmscal plan --out` writes; the same document can be imported."""
    document = pose_sets.export_pose_set(db, pose_set_id)
    name = f"{document['sku']}-r{document['revision']}-{pose_set_id.hex[-8:]}.json"
    response.headers["Content-Disposition"] = f'attachment; filename="{name}"'
    return PoseSetDocument.model_validate(document)
