"""From a camera, a target and a pose space to the ordered pose set, with the accuracy that it promises."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.planning.candidates import Candidates, sample_candidates
from service.core.planning.criterion import PRESETS, Criterion, Objective, Weights, make_criterion
from service.core.planning.curve import CurvePoint, error_curve
from service.core.planning.diversity import Diversity, check_diversity, measure_diversity
from service.core.planning.noise import CornerNoise, noise_at
from service.core.planning.optimiser import Progress, select_poses
from service.core.planning.ordering import order_poses
from service.core.planning.pose_space import Indices, Mask, Poses, PoseSpace
from service.core.planning.prediction import free_parameters, predict_accuracy, zone_within
from service.core.planning.robustness import NOMINAL_ONLY, Robustness, information_by_draw
from service.core.planning.variety import fixed_places, next_place, requirements
from service.core.planning.visibility import measure_visibility
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose
from service.core.vision.uncertainty import GRID, MappingError, Region, compensated_jacobian

# Goes up when the same arguments give another set.
PLANNER: Final = "exchange-2"
FEWEST_POSES: Final = 3
# How much of the work is done when the candidates are known, when the set is found, and the curve.
SAMPLED, SELECTED, CURVED = 0.2, 0.7, 0.98
WEIGHTED: Final = "weighted"
# Of the zone; what is left out of it is promised nothing.
LARGEST_UNREACHED: Final = 0.1


@dataclass(frozen=True)
class PoseSet:
    """An ordered pose set and what it promises.

    poses: `T_cam_board`. expected_norm_px: √E‖Ĉ − C‖². expected_sd: by parameter name, zero where fixed.
    expected_mapping: over the planned zone of the image. condition: of the scaled information. sigma_px:
    corner noise of a frontal board, noise_source: what says how it depends on the pose, pose_sigma_px: the
    noise at each pose. seed, candidates, objective, weights, draws and planner say what made it: the same
    values make the same set. curve: what other numbers of poses would promise; empty where it was not asked
    for.
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
    objective: str = "balanced"
    planner: str = PLANNER
    weights: Weights = PRESETS["balanced"]
    draws: int = 1
    noise_source: str = "one for all poses"
    pose_sigma_px: tuple[float, ...] = ()
    curve: tuple[CurvePoint, ...] = ()


def plan_pose_set(
    intrinsics: Intrinsics,
    target: Target,
    space: PoseSpace,
    count: int,
    seed: int,
    *,
    candidates: int = 3000,
    sigma_px: float | CornerNoise = 0.1,
    objective: Objective = "balanced",
    weights: Weights | None = None,
    robustness: Robustness = NOMINAL_ONLY,
    progress: Progress | None = None,
    fixed: Collection[str] = (),
    zone: Region | None = None,
    with_curve: bool = False,
) -> PoseSet:
    """Return the best set of `count` poses for a camera near `intrinsics`; same arguments, same set.

    sigma_px: expected corner noise, one for all poses or as it depends on them. weights: instead of a named
    objective. robustness: which cameras and hands the set must also suit. fixed: parameters that a
    calibration will not estimate. zone: where the mapping must be right; by default the image without the
    space's margin. progress: called with the share done, 0…1; what it raises ends the planning. Raises
    PoseSpaceEmpty, or PoseSetInfeasible where no set keeps the separation or determines the camera.
    """
    zone = zone or zone_within(intrinsics.image_size, space.image_margin_px)
    report, weighed = progress or _ignore, weights or PRESETS[objective]
    check_count(count, candidates)
    given = sample_candidates(intrinsics, target, space, candidates, seed, sigma_px=sigma_px)
    free = free_parameters(intrinsics.lens, fixed)
    information = information_by_draw(
        intrinsics, target, given, robustness=robustness, rng=np.random.default_rng((seed, 1))
    )[:, :, free[:, None], free]
    J = _mapping_jacobians(intrinsics, zone)[:, :, free]
    criterion = make_criterion(weighed, information.mean(axis=(0, 1)), J)
    search = _Search(given, information, target, space, intrinsics.image_size, criterion, seed)
    report(SAMPLED)
    best = given.poses[search.find(count, _part(report, SAMPLED, SELECTED))]
    best = best[order_poses(best, target)]
    promised = describe_set(intrinsics, target, best, zone, sigma_px=sigma_px, space=space, fixed=fixed)
    curve = search.curve(_part(report, SELECTED, CURVED)) if with_curve else ()
    report(1.0)
    made_by = replace(promised, seed=seed, candidates=candidates, weights=weighed, draws=robustness.draws)
    return replace(made_by, objective=objective if weights is None else WEIGHTED, curve=curve)


def describe_set(
    intrinsics: Intrinsics,
    target: Target,
    poses: Poses,
    zone: Region,
    *,
    sigma_px: float | CornerNoise,
    space: PoseSpace,
    fixed: Collection[str] = (),
) -> PoseSet:
    """Return an ordered set with what it promises; PoseSetInfeasible where its poses are too much alike."""
    seen = measure_visibility(intrinsics, target, poses.rotations, poses.translations)
    diversity = check_diversity(measure_diversity(poses, target, seen.image_points, intrinsics.image_size))
    noise = noise_at(sigma_px, seen, space.depth_of_field_m)
    prediction = predict_accuracy(intrinsics, target, poses, noise, zone, fixed=fixed)
    known = isinstance(sigma_px, CornerNoise)
    return PoseSet(
        poses=tuple(poses.pose(i) for i in range(len(poses))),
        expected_norm_px=prediction.norm_px,
        expected_sd=prediction.sd,
        expected_mapping=prediction.mapping,
        condition=prediction.condition,
        diversity=diversity,
        sigma_px=sigma_px.level_px if isinstance(sigma_px, CornerNoise) else sigma_px,
        noise_source=sigma_px.source if isinstance(sigma_px, CornerNoise) else "one for all poses",
        pose_sigma_px=tuple(float(value) for value in noise) if known else (),
    )


def check_count(count: int, candidates: int) -> int:
    """Return the number of poses; PoseSetInfeasible where it is too small or nothing is left to choose."""
    if count < FEWEST_POSES:
        raise PoseSetInfeasible(
            f"A camera needs at least {FEWEST_POSES} poses, not {count}; raise pose_count.", poses=count
        )
    if candidates < count:
        raise PoseSetInfeasible(
            f"{candidates} candidates cannot give {count} poses; sample at least {100 * count}.",
            candidates=candidates,
        )
    return count


@dataclass(frozen=True)
class _Search:
    """The search among candidates: information (d, m, p, p) of the free parameters, criterion, seed."""

    given: Candidates
    information: Array
    target: Target
    space: PoseSpace
    image_size: tuple[int, int]
    criterion: Criterion
    seed: int

    def find(self, count: int, progress: Progress) -> Indices:
        """Return the best set (count,) that also holds what every set must hold."""
        outer = self.target.outer_corners
        needed = requirements(self.given.poses, self.given.image_points, outer, self.image_size, count)
        places = self._places(count)
        chosen = self._select(count, places, progress)
        while len(places) < count:
            place = next_place(needed, [int(i) for i in chosen])
            if place is None:
                break
            places.append(place)
            chosen = self._select(count, places, _ignore)
        return chosen

    def curve(self, progress: Progress) -> tuple[CurvePoint, ...]:
        """Return what other numbers of poses promise, at the nominal camera."""
        return error_curve(
            self.information[0],
            self.given.image_points,
            self.space.separation_px,
            self.criterion,
            self._places,
            progress=progress,
        )

    def _select(self, count: int, places: list[Mask], progress: Progress) -> Indices:
        return select_poses(
            self.information,
            self.given.image_points,
            count,
            self.space.separation_px,
            self.criterion,
            seed=self.seed,
            slots=places,
            progress=progress,
        )

    def _places(self, count: int) -> list[Mask]:
        return fixed_places(self.given.poses, self.target, self.space, count)


def _mapping_jacobians(intrinsics: Intrinsics, zone: Region) -> Array:
    """Return how pixels of the zone move with the parameters (k, 2, p), NaN where the lens does not reach.

    Rough nominals often fold just before the image corner; PoseSetInfeasible where more than that is lost.
    """
    J = compensated_jacobian(intrinsics, zone.grid(*GRID))
    unreached = int(np.count_nonzero(~np.all(np.isfinite(J), axis=(1, 2))))
    if unreached > LARGEST_UNREACHED * len(J):
        raise PoseSetInfeasible(
            f"The lens model folds back inside the zone: it reaches only {len(J) - unreached} of {len(J)} "
            "places of it, so that nothing can be promised for the rest. Correct the nominal's coefficients, "
            "choose a lens model for wide lenses, or give a smaller working_zone.",
            unreached=unreached,
            places=len(J),
        )
    return J


def _part(report: Progress, begin: float, end: float) -> Progress:
    """Return the progress of one part of the work."""
    return lambda share: report(begin + (end - begin) * share)


def _ignore(share: float) -> None:
    """Report nothing."""
