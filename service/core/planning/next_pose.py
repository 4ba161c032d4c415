"""Which pose to take next where the plan cannot be kept: an open one of the set, or a new one.

Not here: why it cannot, and that it is recorded.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from service.core.planning.candidates import Candidates
from service.core.planning.criterion import Criterion
from service.core.planning.ordering import hand_times
from service.core.planning.pose_space import Mask, Poses
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose

# In units of the mean information of a pose; before some captures nothing else makes the covariance finite.
WEAK_PRIOR: Final = 1e-6
SETTLING_S: Final = 3.0  # that a pose takes beside the way to it


def choose_next_pose(
    poses: Poses,
    target: Target,
    information: Array,
    criterion: Criterion,
    *,
    captured: Sequence[int],
    candidates: Sequence[int],
    hand: Pose | None,
) -> int:
    """Return the candidate that tells most about the camera for its time: what is known already, and the way.

    information: (m, p, p) of the m poses about the free parameters. hand: where the board is, None where it
    is not known, so that every way counts alike.
    """
    gains = information_gains(information, criterion, captured, candidates)
    return int(candidates[int(np.argmax(gains / (SETTLING_S + _ways_s(poses, target, candidates, hand))))])


def information_gains(
    information: Array, criterion: Criterion, captured: Sequence[int], candidates: Sequence[int]
) -> Array:
    """Return by how much each candidate (k,) makes the criterion smaller, as the logarithm of the ratio."""
    scale = 1.0 / np.sqrt(np.diagonal(information.mean(axis=0)))
    scaling = scale * scale[:, None]
    scaled, metric = information * scaling, criterion.metric * scaling
    known = WEAK_PRIOR * np.eye(len(scale)) + scaled[list(captured)].sum(axis=0)
    before = np.trace(metric @ np.linalg.inv(known))
    after = np.trace(metric @ np.linalg.inv(known + scaled[list(candidates)]), axis1=1, axis2=2)
    return np.asarray(np.log(before / after), dtype=np.float64)


def fresh_candidates(
    pool: Candidates, taken: Array, separation_px: float, avoided: Array, away_px: float
) -> Mask:
    """Return which candidates (m,) are new: apart from those that are taken and well away from those avoided.

    taken (t, n, 2), avoided (a, n, 2): their corners, px; distances are means over the corners.
    """
    return _apart(pool.image_points, taken, separation_px) & _apart(pool.image_points, avoided, away_px)


def _apart(points: Array, others: Array, least_px: float) -> Mask:
    mask = np.ones(len(points), dtype=np.bool_)
    for other in others:
        mask &= np.linalg.norm(points - other, axis=-1).mean(axis=1) >= least_px
    return mask


def _ways_s(poses: Poses, target: Target, candidates: Sequence[int], hand: Pose | None) -> Array:
    """Return the times (k,), s, that a hand needs to the candidates."""
    if hand is None:
        return np.zeros(len(candidates))
    chosen = poses[list(candidates)]
    here = Poses(
        np.concatenate([hand.rotation[None], chosen.rotations]),
        np.concatenate([hand.tvec[None], chosen.translations]),
    )
    return np.asarray(hand_times(here, target)[0, 1:], dtype=np.float64)
