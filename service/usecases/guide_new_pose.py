"""A pose that is not of the set, chosen from the SKU's pose space by what it adds to the captures so far.

Not here: when one is asked for (the session's reducer), and its record (`added_poses`).
"""

from collections.abc import Collection
from typing import Final

import numpy as np

from service.core.errors import PoseSpaceEmpty
from service.core.guidance.actions import AddedFor, PoseWanted
from service.core.guidance.session_state import SessionState
from service.core.planning.candidates import Candidates, sample_candidates
from service.core.planning.next_pose import choose_next_pose, fresh_candidates
from service.core.planning.noise import FITTED_NOISE
from service.core.planning.pose_space import Poses
from service.core.vision.camera import project
from service.core.vision.transforms import Array, Pose, stack_poses
from service.usecases.guide_next_pose import known_by_poses, planning_criterion
from service.usecases.sku_document import Revision

POOL: Final = 600
# Of the image width: so far from a pose that hands did not reach, on average over the corners.
AWAY_SHARE: Final = 0.12


def choose_new_pose(
    revision: Revision, state: SessionState, wanted: PoseWanted, hand: Pose | None
) -> Pose | None:
    """Return the pose that adds most to the captures for its way; None where there is no new one.

    It is apart from every pose that is captured or open, and well away from those that are out of reach. The
    same state gives the same pose.
    """
    try:
        pool = _pool(revision, seed=len(state.expected))
    except PoseSpaceEmpty:
        return None
    unreached = _unreached(state, wanted)
    kept = (set(state.captured) | set(state.open)) - unreached - {wanted.replaces}
    away_px = AWAY_SHARE * revision.intrinsics.image_size[0]
    separation_px = revision.pose_space.separation_px
    fresh = fresh_candidates(
        pool, _seen(revision, state, kept), separation_px, _seen(revision, state, unreached), away_px
    )
    if not fresh.any():
        return None
    captured = [i for i in state.order if i != wanted.replaces]
    known = stack_poses([state.expected[i] for i in captured])
    poses = Poses(
        np.concatenate([known[0], pool.poses.rotations[fresh]]),
        np.concatenate([known[1], pool.poses.translations[fresh]]),
    )
    information = known_by_poses(revision, poses)
    chosen = choose_next_pose(
        poses,
        revision.target,
        information,
        planning_criterion(revision, information),
        captured=range(len(captured)),
        candidates=range(len(captured), len(poses)),
        hand=hand,
    )
    return poses.pose(chosen)


def _pool(revision: Revision, seed: int) -> Candidates:
    return sample_candidates(
        revision.intrinsics,
        revision.target,
        revision.pose_space,
        POOL,
        seed,
        sigma_px=FITTED_NOISE.at_level(revision.corner_noise_px),
    )


def _unreached(state: SessionState, wanted: PoseWanted) -> set[int]:
    """Return the poses that hands did not reach in this run."""
    before = {one.replaces for one in state.added if one.reason is AddedFor.OUT_OF_REACH}
    now = {wanted.replaces} if wanted.reason is AddedFor.OUT_OF_REACH else set()
    return {i for i in (*before, *now, *state.postponed) if i is not None and i not in state.captured}


def _seen(revision: Revision, state: SessionState, indices: Collection[int | None]) -> Array:
    """Return the corners (m, n, 2) px of some of a session's poses in the nominal image."""
    poses = [state.expected[i] for i in indices if i is not None]
    return project(revision.intrinsics, *stack_poses(poses), revision.target.object_points)
