"""The poses that a run asks for: those of its pose set, then those that were added to it.

Not here: how one is added (`added_poses`).
"""

from collections.abc import Sequence
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.guidance.actions import AddedPose
from service.core.vision.transforms import Pose
from service.storage.models import PoseSetRow, RunPoseRow, RunRow
from service.usecases.observation import pose_from_json


def read_prescribed(session: Session, run: RunRow) -> tuple[Pose, ...] | None:
    """Return the poses of a run's set; None without one."""
    pose_set = None if run.pose_set_id is None else session.get_one(PoseSetRow, run.pose_set_id)
    return None if pose_set is None else tuple(pose_from_json(pose) for pose in pose_set.poses)


def read_added(session: Session, run_id: UUID) -> Sequence[RunPoseRow]:
    """Return the poses that were added to a run, in the order of their indices."""
    query = select(RunPoseRow).where(RunPoseRow.run_id == run_id).order_by(RunPoseRow.pose_index)
    return session.scalars(query).all()


def view_added(row: RunPoseRow) -> AddedPose:
    """Return an added pose as guidance needs it."""
    return AddedPose(pose_from_json(row.pose), row.reason, row.replaces)
