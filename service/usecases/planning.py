"""Planning a pose set for a SKU revision, as a job or at once; what is said of a set made elsewhere."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal
from uuid import UUID

import numpy as np
from sqlalchemy.orm import Session

from service.core.errors import NotFound
from service.core.planning.bootstrap import compare_plans
from service.core.planning.criterion import Objective, Weights
from service.core.planning.curve import smallest_count
from service.core.planning.document import pose_from_dict, pose_set_to_dict, pose_to_dict
from service.core.planning.noise import FITTED_NOISE
from service.core.planning.optimiser import Progress
from service.core.planning.paper import plan_as_the_paper
from service.core.planning.plan import PoseSet, describe_set, plan_pose_set
from service.core.planning.pose_space import Poses
from service.core.planning.prediction import zone_within
from service.core.planning.robustness import DRAWS, Robustness
from service.core.vision.transforms import Pose, stack_poses
from service.ports import JobCompletion, JobHandler, JobRun
from service.storage.database import Database
from service.storage.models import PoseSetRow, SkuRevisionRow
from service.usecases.sku_document import Revision, SkuDocument

JsonObject = dict[str, Any]
Planner = Literal["exchange", "paper"]
PLAN_POSE_SET = "plan-pose-set"


@dataclass(frozen=True)
class PlanRequest:
    """How to plan: the same values give the same poses.

    planner: ours, or the paper's procedure as the baseline to compare with. weights: instead of an objective.
    draws: cameras and hands that a set is judged by. sets: random ones that the paper's procedure tries.
    follows: the set, of another revision, that this one continues after a better estimate of the camera.
    """

    seed: int = 0
    candidates: int = 3000
    objective: Objective = "balanced"
    weights: Weights | None = None
    draws: int = DRAWS
    planner: Planner = "exchange"
    sets: int = 1000
    follows: str | None = None

    def to_json(self) -> JsonObject:
        """Return the form in which the request waits for its job."""
        return asdict(self)

    @classmethod
    def from_json(cls, stored: JsonObject) -> "PlanRequest":
        """Return the request of its waiting form; what older requests do not name takes its default."""
        known = {name: stored[name] for name in cls.__dataclass_fields__ if stored.get(name) is not None}
        weights = known.pop("weights", None)
        return cls(**known, weights=None if weights is None else Weights(**weights))


def plan_for(
    revision: Revision, plan: PlanRequest, progress: Progress | None = None, *, count: int | None = None
) -> PoseSet:
    """Return the set that a request gives for a revision; count: instead of the revision's.

    Raises PoseSpaceEmpty, PoseSetInfeasible.
    """
    wanted = revision.pose_count if count is None else count
    if plan.planner == "paper":
        return plan_as_the_paper(
            revision.intrinsics,
            revision.target,
            revision.pose_space,
            wanted,
            plan.seed,
            candidates=plan.candidates,
            sets=plan.sets,
            sigma_px=revision.corner_noise_px,
            progress=progress,
            zone=revision.working_zone,
        )
    return plan_pose_set(
        revision.intrinsics,
        revision.target,
        revision.pose_space,
        wanted,
        plan.seed,
        candidates=plan.candidates,
        sigma_px=FITTED_NOISE.at_level(revision.corner_noise_px),
        objective=plan.objective,
        weights=plan.weights,
        robustness=Robustness(draws=plan.draws, tolerance=revision.tolerance),
        progress=progress,
        fixed=revision.fixed,
        zone=revision.working_zone,
        with_curve=True,
    )


def planned_document(revision: Revision, pose_set: PoseSet) -> JsonObject:
    """Return the form in which a set is stored and sent: with how many poses the revision really needs."""
    document = pose_set_to_dict(pose_set)
    document["prediction"] |= {
        "required_mapping_px": revision.required_mapping_px,
        "smallest_count": smallest_count(pose_set.curve, revision.required_mapping_px),
    }
    return document


def plan_pose_set_job(database: Database) -> JobHandler:
    """Return the handler of the jobs that plan pose sets."""

    def handle(run: JobRun) -> JobCompletion:
        pose_set_id = UUID(run.arguments["pose_set_id"])
        with database.read() as session:
            revision, plan = _load(session, pose_set_id)
            before = _poses_before(session, plan)
        pose_set = plan_for(revision, plan, run.report)
        document = planned_document(revision, pose_set)
        if before:
            document["provenance"]["follows"] = _shift(revision, plan, before, pose_set)

        def complete(session: Session) -> JsonObject:
            row = session.get_one(PoseSetRow, pose_set_id)
            row.poses, row.prediction, row.provenance = (
                document["poses"],
                document["prediction"],
                document["provenance"],
            )
            return {"pose_set_id": str(pose_set_id), "prediction": document["prediction"]}

        return complete

    return handle


def describe_import(revision: Revision, poses: Sequence[Pose]) -> JsonObject:
    """Return the stored form of given poses with what they promise.

    Raises PoseSetInfeasible when the set does not determine the camera.
    """
    rotations, translations = stack_poses(list(poses))
    described = describe_set(
        revision.intrinsics,
        revision.target,
        Poses(rotations, translations),
        revision.working_zone
        or zone_within(revision.intrinsics.image_size, revision.pose_space.image_margin_px),
        sigma_px=FITTED_NOISE.at_level(revision.corner_noise_px),
        space=revision.pose_space,
        fixed=revision.fixed,
    )
    document = planned_document(revision, described)
    provenance = {name: document["provenance"][name] for name in ("sigma_px", "noise_source")}
    return {
        **document,
        # As they were given: a way through rotation matrices would change the last digit.
        "poses": [pose_to_dict(pose) for pose in poses],
        "provenance": {"planner": "imported", **provenance},
    }


def _load(session: Session, pose_set_id: UUID) -> tuple[Revision, PlanRequest]:
    row = session.get(PoseSetRow, pose_set_id)
    if row is None:
        raise NotFound("The pose set of this job is gone. Request a new one.", pose_set_id=str(pose_set_id))
    document = session.get_one(SkuRevisionRow, row.sku_revision_id).document
    return SkuDocument.model_validate(document).to_revision(), PlanRequest.from_json(row.provenance)


def _poses_before(session: Session, plan: PlanRequest) -> list[Pose]:
    """Return the poses of the set that a request continues; none where it continues none."""
    row = None if plan.follows is None else session.get(PoseSetRow, UUID(plan.follows))
    return [] if row is None else [pose_from_dict(stored) for stored in row.poses]


def _shift(revision: Revision, plan: PlanRequest, before: Sequence[Pose], pose_set: PoseSet) -> JsonObject:
    """Return what the better estimate did to the plan before; its ratio is null where that plan is lost."""
    shift = compare_plans(
        revision.intrinsics,
        revision.target,
        revision.pose_space,
        old=before,
        new=pose_set.poses,
        zone=revision.working_zone,
        fixed=revision.fixed,
    )
    return {
        "pose_set_id": plan.follows,
        "accuracy_ratio": shift.accuracy_ratio if np.isfinite(shift.accuracy_ratio) else None,
        "hidden": list(shift.hidden),
        "is_settled": shift.is_settled,
    }
