"""A camera of which only the data sheet is known: plan, capture, estimate, plan again, until the plan holds.

A first plan from a rough nominal is good enough to see the camera with; the second one is for the camera that
is really there. Not here: how captures are taken (`take`), and SKU revisions.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.plan import PoseSet
from service.core.planning.pose_space import Poses, PoseSpace, infeasibilities
from service.core.planning.prediction import predict_accuracy, zone_within
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, focal_of_view
from service.core.vision.target import Target
from service.core.vision.transforms import Pose, stack_poses
from service.core.vision.uncertainty import Region

# A plan holds when a new one would promise less than this much more accuracy.
SETTLED_RATIO: Final = 1.1
MOST_ROUNDS: Final = 5


@dataclass(frozen=True)
class PlanShift:
    """What a camera's better estimate does to a plan made before.

    accuracy_ratio: what the old poses promise over what the new ones do, as expected mapping error at the new
    estimate; inf where the old poses do not determine the camera. hidden: old poses (from 0) at which the
    board would leave its bounds.
    """

    accuracy_ratio: float
    hidden: tuple[int, ...]

    @property
    def is_settled(self) -> bool:
        """Whether the old plan may stay."""
        return self.accuracy_ratio <= SETTLED_RATIO and not self.hidden


@dataclass(frozen=True)
class Round:
    """One round: the nominal that was planned for, the set, the estimate from its captures, and the shift."""

    nominal: Intrinsics
    pose_set: PoseSet
    estimate: Intrinsics
    shift: PlanShift


def nominal_of_data_sheet(
    lens: str, image_size: tuple[int, int], hfov_deg: float, vfov_deg: float | None = None
) -> Intrinsics:
    """Return intrinsics without distortion whose image spans the fields of view.

    Pixels are square without vfov_deg. A pinhole's image grows with the tangent, a fisheye's with the angle:
    f = half size / tan(half angle), or over the half angle itself. Raises IntrinsicsInvalid for angles that
    such a lens cannot have.
    """
    fx = focal_of_view(lens, image_size[0], hfov_deg)
    fy = fx if vfov_deg is None else focal_of_view(lens, image_size[1], vfov_deg)
    centre = {"cx": (image_size[0] - 1) / 2.0, "cy": (image_size[1] - 1) / 2.0}
    return Intrinsics.from_parameters(lens, {"fx": fx, "fy": fy, **centre}, image_size)


def compare_plans(
    estimate: Intrinsics,
    target: Target,
    space: PoseSpace,
    *,
    old: Sequence[Pose],
    new: Sequence[Pose],
    zone: Region | None = None,
    fixed: Sequence[str] = (),
) -> PlanShift:
    """Return how much better a new plan is than an old one for a camera as it is now estimated."""
    zone = zone or zone_within(estimate.image_size, space.image_margin_px)
    before, after = (Poses(*stack_poses(list(poses))) for poses in (old, new))
    # The margin is the plan's reserve against just this; only a board that leaves the image is lost.
    bounds = infeasibilities(replace(space, image_margin_px=0.0), estimate, target, before)
    hidden = np.flatnonzero(bounds["image_margin_px"] | bounds["lens"])

    def error_px(poses: Poses) -> float:
        try:
            return predict_accuracy(estimate, target, poses, 1.0, zone, fixed=fixed).mapping.mean_px
        except PoseSetInfeasible:
            return math.inf

    best = error_px(after)
    ratio = error_px(before) / best if math.isfinite(best) else math.inf
    return PlanShift(ratio, tuple(int(i) for i in hidden))


def bootstrap(
    nominal: Intrinsics,
    plan: Callable[[Intrinsics], PoseSet],
    take: Callable[[PoseSet], Sequence[View]],
    target: Target,
    space: PoseSpace,
) -> tuple[Round, ...]:
    """Return the rounds until the plan holds, MOST_ROUNDS at most; the last one's estimate is the camera.

    plan: makes a set for a camera. take: captures it, as views (n, 3) m and (n, 2) px. Raises what planning
    and `calibrate_intrinsics` raise.
    """
    rounds: list[Round] = []
    pose_set = plan(nominal)
    while len(rounds) < MOST_ROUNDS:
        result = calibrate_intrinsics(list(take(pose_set)), nominal.image_size, nominal.lens, nominal=nominal)
        better = plan(result.intrinsics)
        shift = compare_plans(result.intrinsics, target, space, old=pose_set.poses, new=better.poses)
        rounds.append(Round(nominal, pose_set, result.intrinsics, shift))
        if shift.is_settled:
            break
        nominal, pose_set = result.intrinsics, better
    return tuple(rounds)
