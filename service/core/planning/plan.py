"""From a camera, a target and a pose space to the ordered pose set, with the accuracy that it promises."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.diversity import Diversity, check_diversity, measure_diversity
from service.core.planning.information import pose_information
from service.core.planning.optimiser import Progress, select_poses
from service.core.planning.ordering import order_poses
from service.core.planning.pose_space import Mask, Poses, PoseSpace, sample_poses
from service.core.planning.prediction import free_parameters, predict_accuracy, zone_within
from service.core.planning.scoring import Objective
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Pose
from service.core.vision.uncertainty import MappingError, Region, parameter_metric

# Goes up when the same arguments give another set.
PLANNER: Final = "exchange-1"
FEWEST_POSES: Final = 3
# A board turned by no more than this is one that anyone can hit at the first try.
EASY_TURN_RAD: Final = float(np.deg2rad(20.0))
# A distance range counts as near and far from this ratio on; then this share of the poses is in its far half.
DISTINCT_RATIO: Final = 1.2
FAR_SHARE: Final = 0.25
# How much of the work is done when the candidates are known, and when the set is found.
SAMPLED, SELECTED = 0.3, 0.95


@dataclass(frozen=True)
class PoseSet:
    """An ordered pose set and what it promises for a corner noise of sigma_px.

    poses: `T_cam_board`. expected_norm_px: √E‖Ĉ − C‖². expected_sd: by parameter name, zero where fixed.
    expected_mapping: over the planned zone of the image. condition: of the scaled information. seed,
    candidates, objective and planner say what made it: the same values make the same set.
    """

    poses: tuple[Pose, ...]
    expected_norm_px: float
    expected_sd: dict[str, float]
    expected_mapping: MappingError
    condition: float
    diversity: Diversity
    sigma_px: float
    seed: int = 0
    candidates: int = 0
    objective: Objective = "balanced"
    planner: str = PLANNER


def plan_pose_set(
    intrinsics: Intrinsics,
    target: Chessboard,
    space: PoseSpace,
    count: int,
    seed: int,
    *,
    candidates: int = 3000,
    sigma_px: float = 0.1,
    objective: Objective = "balanced",
    progress: Progress | None = None,
    fixed: Collection[str] = (),
    zone: Region | None = None,
) -> PoseSet:
    """Return the best set of `count` poses for a camera near `intrinsics`; same arguments, same set.

    sigma_px: expected corner noise. fixed: parameters that a calibration will not estimate. zone: where the
    mapping must be right; by default the image without the space's margin. progress: called with the share
    done, 0…1; what it raises ends the planning. Raises PoseSpaceEmpty, or PoseSetInfeasible where no set
    keeps the separation or determines the camera.
    """
    zone = zone or zone_within(intrinsics.image_size, space.image_margin_px)
    report = progress or _ignore
    check_count(count, candidates)
    poses = sample_poses(space, intrinsics, target, candidates, seed)
    report(SAMPLED)
    free = free_parameters(intrinsics.lens, fixed)
    information = pose_information(intrinsics, target, poses, sigma_px)
    chosen = select_poses(
        information[:, free[:, None], free],
        project(intrinsics, poses.rotations, poses.translations, target.object_points),
        count,
        space.separation_px,
        H=parameter_metric(intrinsics, zone)[np.ix_(free, free)],
        objective=objective,
        seed=seed,
        slots=required_variety(poses, target, space, count),
        progress=lambda share: report(SAMPLED + (SELECTED - SAMPLED) * share),
    )
    best = poses[chosen]
    best = best[order_poses(best, target)]
    promised = _promise(intrinsics, target, best, sigma_px, zone, fixed=fixed)
    report(1.0)
    return replace(promised, seed=seed, candidates=candidates, objective=objective)


def _promise(
    intrinsics: Intrinsics,
    target: Chessboard,
    best: Poses,
    sigma_px: float,
    zone: Region,
    *,
    fixed: Collection[str],
) -> PoseSet:
    """What an ordered set promises. Raises PoseSetInfeasible where its poses are too much alike."""
    pixels = project(intrinsics, best.rotations, best.translations, target.object_points)
    diversity = check_diversity(measure_diversity(best, target, pixels, intrinsics.image_size))
    prediction = predict_accuracy(intrinsics, target, best, sigma_px, zone, fixed=fixed)
    return PoseSet(
        poses=tuple(best.pose(i) for i in range(len(best))),
        expected_norm_px=prediction.norm_px,
        expected_sd=prediction.sd,
        expected_mapping=prediction.mapping,
        condition=prediction.condition,
        diversity=diversity,
        sigma_px=sigma_px,
    )


def check_count(count: int, candidates: int) -> int:
    """Return the number of poses; PoseSetInfeasible where it is too small or nothing is left to choose."""
    if count < FEWEST_POSES:
        raise PoseSetInfeasible(f"A camera needs at least {FEWEST_POSES} poses, not {count}.", poses=count)
    if candidates < count:
        raise PoseSetInfeasible(
            f"{candidates} candidates cannot give {count} poses; sample at least {100 * count}.",
            candidates=candidates,
        )
    return count


def required_variety(poses: Poses, target: Chessboard, space: PoseSpace, count: int) -> list[Mask]:
    """Return which candidates (m,) may take the first places of a set: one easy pose, then some far ones.

    On paper every board is best as near as it may come; the camera works over the whole range, and what the
    model leaves out (a warped board, blur) must not come from one distance alone. A range that is too
    narrow for near and far asks for nothing.
    """
    near, far = space.distance_m
    easy = poses.turns() <= EASY_TURN_RAD
    distant = np.linalg.norm(poses.centres(target), axis=1) >= (near + far) / 2.0
    slots = [easy if np.any(easy) else np.ones(len(poses), bool)]
    if far > DISTINCT_RATIO * near and np.count_nonzero(distant) >= count:
        slots += [distant] * int(FAR_SHARE * count)
    return slots


def _ignore(share: float) -> None:
    """Report nothing."""
