"""Another pose first, where an operator does not reach the one that is asked for: which one, and its record.

The record is also what a resumed session knows of it. Not here: when a pose counts as not reached (the
session's reducer).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.guidance.session_state import SessionState
from service.core.planning.criterion import PRESETS, Criterion, make_criterion
from service.core.planning.information import pose_information
from service.core.planning.next_pose import choose_next_pose
from service.core.planning.noise import FITTED_NOISE, noise_at
from service.core.planning.pose_space import Poses
from service.core.planning.prediction import free_parameters, zone_within
from service.core.planning.visibility import measure_visibility
from service.core.vision.transforms import Array, Pose, stack_poses
from service.core.vision.uncertainty import GRID, compensated_jacobian
from service.storage.models import AuditEntryRow
from service.usecases.audit import record
from service.usecases.sku_document import Revision

POSTPONE = "run.postpone_pose"


@dataclass(frozen=True)
class Postponed:
    """A pose that comes after all others, and the one that is asked for in its place."""

    pose_index: int
    next_index: int
    tried_s: float


def choose_another(revision: Revision, state: SessionState, hand: Pose | None) -> int | None:
    """Return the open pose that helps most for its way from where the board is; None without another one.

    Poses that were postponed already are chosen only where there is no other.
    """
    others = [i for i in state.open if i != state.current]
    fresh = [i for i in others if i not in state.postponed]
    if not others:
        return None
    poses = Poses(*stack_poses(list(state.expected)))
    information = known_by_poses(revision, poses)
    return choose_next_pose(
        poses,
        revision.target,
        information,
        planning_criterion(revision, information),
        captured=state.order,
        candidates=fresh or others,
        hand=hand,
    )


def known_by_poses(revision: Revision, poses: Poses) -> Array:
    """Return what poses tell about the free parameters of the nominal camera (m, p, p)."""
    intrinsics, target = revision.intrinsics, revision.target
    free = free_parameters(intrinsics.lens, revision.fixed)
    seen = measure_visibility(intrinsics, target, poses.rotations, poses.translations)
    level = FITTED_NOISE.at_level(revision.corner_noise_px)
    noise = noise_at(level, seen, revision.pose_space.depth_of_field_m)
    return pose_information(intrinsics, target, poses, noise)[:, free[:, None], free]


def planning_criterion(revision: Revision, information: Array) -> Criterion:
    """Return what a SKU's poses are chosen by, as in planning; information: (m, p, p) of candidates."""
    intrinsics = revision.intrinsics
    free = free_parameters(intrinsics.lens, revision.fixed)
    zone = revision.working_zone or zone_within(intrinsics.image_size, revision.pose_space.image_margin_px)
    J = compensated_jacobian(intrinsics, zone.grid(*GRID))[:, :, free]
    return make_criterion(PRESETS["balanced"], information.mean(axis=0), J)


def record_postponed(session: Session, run_id: UUID, postponed: Postponed, who: str, now: datetime) -> None:
    """Write down which pose was put off, for which one, and how long it had been tried."""
    record(
        session,
        now,
        who,
        POSTPONE,
        f"run:{run_id}",
        pose_index=postponed.pose_index,
        next_index=postponed.next_index,
        tried_s=round(postponed.tried_s, 1),
    )


def read_postponed(session: Session, run_id: UUID) -> tuple[int, ...]:
    """Return the poses of a run that were put off, in the order in which they come again."""
    query = (
        select(AuditEntryRow.facts)
        .where(AuditEntryRow.subject == f"run:{run_id}", AuditEntryRow.action == POSTPONE)
        .order_by(AuditEntryRow.at, AuditEntryRow.id)
    )
    return _order(facts["pose_index"] for facts in session.scalars(query))


def _order(changes: Iterable[int]) -> tuple[int, ...]:
    later: list[int] = []
    for put_off in changes:
        later = [*(i for i in later if i != put_off), put_off]
    return tuple(later)
