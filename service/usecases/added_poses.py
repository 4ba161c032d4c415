"""Poses that a run asks for beyond its set: kept with the run, so that whoever takes it again asks alike.

Their indices follow those of the set. Not here: when one is asked for (the guidance session), and which one
(`guide_new_pose`).
"""

from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.guidance.actions import AddedPose
from service.storage.models import CaptureRow, RunPoseRow
from service.usecases.audit import record
from service.usecases.captures import lock_open_run, withdraw_capture
from service.usecases.observation import JsonObject, pose_to_json
from service.usecases.run_poses import view_added


@dataclass(frozen=True)
class NewPose:
    """A pose to add at an index; tried_s: how long the one that it replaces was tried."""

    pose_index: int
    added: AddedPose
    tried_s: float = 0.0


def add_run_pose(session: Session, run_id: UUID, new: NewPose, who: str, now: datetime) -> AddedPose:
    """Return the pose of an index of an open run, added now unless another session was faster.

    The capture of a pose that is replaced is withdrawn. Raises NotFound, RunAlreadyFinished, RunAborted.
    """
    lock_open_run(session, run_id)
    query = select(RunPoseRow).where(RunPoseRow.run_id == run_id, RunPoseRow.pose_index == new.pose_index)
    known = session.scalar(query)
    if known is not None:
        return view_added(known)
    replaces, reason = new.added.replaces, new.added.reason
    session.add(
        RunPoseRow(
            run_id=run_id,
            pose_index=new.pose_index,
            pose=pose_to_json(new.added.pose),
            reason=reason,
            replaces=replaces,
            created_at=now,
        )
    )
    facts: JsonObject = {"pose_index": new.pose_index, "reason": reason.value}
    if replaces is not None:
        facts["replaces"] = replaces
        _withdraw(session, run_id, replaces, who, now)
    if new.tried_s:
        facts["tried_s"] = round(new.tried_s, 1)
    record(session, now, who, "run.add_pose", f"run:{run_id}", **facts)
    return new.added


def _withdraw(session: Session, run_id: UUID, pose_index: int, who: str, now: datetime) -> None:
    query = select(CaptureRow.id).where(CaptureRow.run_id == run_id, CaptureRow.pose_index == pose_index)
    for capture_id in session.scalars(query):
        withdraw_capture(session, run_id, capture_id, who, now)
