"""The job that plans a pose set, and what is said about a set that was planned elsewhere."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy.orm import Session

from service.core.errors import NotFound, PoseSetInfeasible
from service.core.planning.diversity import check_diversity, measure_diversity
from service.core.planning.document import pose_set_to_dict, pose_to_dict
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import Poses
from service.core.planning.prediction import predict_accuracy, zone_within
from service.core.planning.scoring import Objective
from service.core.vision.camera import project
from service.core.vision.transforms import Array, Pose, stack_poses
from service.ports import JobCompletion, JobHandler, JobRun
from service.storage.database import Database
from service.storage.models import PoseSetRow, SkuRevisionRow
from service.usecases.sku_document import Revision, SkuDocument

JsonObject = dict[str, Any]
PLAN_POSE_SET = "plan-pose-set"


@dataclass(frozen=True)
class PlanRequest:
    """How to plan: the same values give the same poses."""

    seed: int
    candidates: int
    objective: Objective

    def to_json(self) -> JsonObject:
        """Return the form in which the request waits for its job."""
        return asdict(self)


def plan_pose_set_job(database: Database) -> JobHandler:
    """Return the handler of the jobs that plan pose sets."""

    def handle(run: JobRun) -> JobCompletion:
        pose_set_id = UUID(run.arguments["pose_set_id"])
        with database.read() as session:
            revision, plan = _load(session, pose_set_id)
        document = pose_set_to_dict(
            plan_pose_set(
                revision.intrinsics,
                revision.target,
                revision.pose_space,
                revision.pose_count,
                plan.seed,
                candidates=plan.candidates,
                sigma_px=revision.corner_noise_px,
                objective=plan.objective,
                progress=run.report,
                fixed=revision.fixed,
                zone=revision.working_zone,
            )
        )

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

    Raises PoseSetInfeasible naming the poses at which the board is not wholly in the image, or when the set
    does not determine the camera.
    """
    rotations, translations = stack_poses(list(poses))
    pixels = project(revision.intrinsics, rotations, translations, revision.target.object_points)
    _check_visible(pixels, revision.intrinsics.image_size)
    zone = revision.working_zone or zone_within(
        revision.intrinsics.image_size, revision.pose_space.image_margin_px
    )
    stacked = Poses(rotations, translations)
    prediction = predict_accuracy(
        revision.intrinsics, revision.target, stacked, revision.corner_noise_px, zone, fixed=revision.fixed
    )
    diversity = check_diversity(
        measure_diversity(stacked, revision.target, pixels, revision.intrinsics.image_size)
    )
    return {
        "poses": [pose_to_dict(pose) for pose in poses],
        "prediction": {
            "norm_px": prediction.norm_px,
            "sd": prediction.sd,
            "mapping": asdict(prediction.mapping),
            "condition": prediction.condition,
            "diversity": asdict(diversity),
        },
        "provenance": {"planner": "imported", "sigma_px": revision.corner_noise_px},
    }


def _check_visible(pixels: Array, image_size: tuple[int, int]) -> None:
    """Refuse poses whose corners (m, n, 2) px are not all in the image.

    Written so that NaN (behind it) is refused.
    """
    inside = (pixels >= 0) & (pixels <= np.array(image_size) - 1.0)
    hidden = [int(i) for i in np.flatnonzero(~np.all(inside, axis=(1, 2)))]
    if hidden:
        raise PoseSetInfeasible(
            f"The board is not wholly in the image at pose {', '.join(map(str, hidden))} (from 0). Poses "
            "are T_cam_board: "
            "rotation vector in rad and translation of the board's first corner in m.",
            poses=hidden,
        )


def _load(session: Session, pose_set_id: UUID) -> tuple[Revision, PlanRequest]:
    row = session.get(PoseSetRow, pose_set_id)
    if row is None:
        raise NotFound("The pose set of this job is gone. Request a new one.", pose_set_id=str(pose_set_id))
    document = session.get_one(SkuRevisionRow, row.sku_revision_id).document
    plan = PlanRequest(row.provenance["seed"], row.provenance["candidates"], row.provenance["objective"])
    return SkuDocument.model_validate(document).to_revision(), plan
