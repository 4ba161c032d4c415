"""The paper's own procedure, kept as the baseline that every comparison shows; never the default.

Poses uniform in space, sets of N drawn at random, each calibrated from one noisy draw, and the set with the
largest S = 1 / (α·MRE + β·‖Ĉ − C‖) kept (Ren and Hu, Camera Calibration with Pose Guidance). One noisy draw
also rewards luck. Not here: the planner that the service uses (`plan`).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from service.core.errors import PoseSetInfeasible, ServiceError
from service.core.planning.optimiser import Progress
from service.core.planning.plan import PoseSet, describe_set
from service.core.planning.pose_space import Indices, Poses, PoseSpace, check_pose_space, infeasibilities
from service.core.planning.prediction import zone_within
from service.core.planning.scoring import paper_score
from service.core.vision.calibration import CalibrationResult, View, calibrate_intrinsics
from service.core.vision.camera import Intrinsics, project, unproject
from service.core.vision.residuals import mean_reprojection_error
from service.core.vision.target import Target
from service.core.vision.transforms import Array, rotation_matrix
from service.core.vision.uncertainty import Region

LARGEST_BATCHES = 200
PAPER_PLANNER: Final = "paper-1"
PAPER_OBJECTIVE: Final = "score"


@dataclass(frozen=True)
class ScoredSet:
    """A candidate set by the indices (n,) of its poses, with what one noisy draw made of it."""

    indices: Indices
    mre_px: float
    norm: float
    score: float


def plan_as_the_paper(
    intrinsics: Intrinsics,
    target: Target,
    space: PoseSpace,
    count: int,
    seed: int,
    *,
    candidates: int = 3000,
    sets: int = 1000,
    sigma_px: float = 0.1,
    alpha: float = 1.0,
    beta: float = 1.0,
    progress: Progress | None = None,
    zone: Region | None = None,
) -> PoseSet:
    """Return the set that the paper's procedure picks, in the order it was drawn, with what it really
    promises.

    progress: as for `plan_pose_set`. Raises what `sample_uniform_poses` raises, and PoseSetInfeasible where
    the pick does not determine the camera.
    """
    rng = np.random.default_rng(seed)
    poses = sample_uniform_poses(space, intrinsics, target, candidates, rng)
    scored = score_random_sets(
        intrinsics, target, poses, count, rng, sets=sets, sigma_px=sigma_px, alpha=alpha, beta=beta
    )
    best: ScoredSet | None = None
    for done, one in enumerate(scored, start=1):
        best = one if best is None or one.score > best.score else best
        if progress is not None:
            progress(done / sets)
    if best is None:
        raise PoseSetInfeasible("The paper's procedure needs at least one candidate set.", sets=sets)
    zone = zone or zone_within(intrinsics.image_size, space.image_margin_px)
    described = describe_set(intrinsics, target, poses[best.indices], zone, sigma_px=sigma_px, space=space)
    return replace(
        described, seed=seed, candidates=candidates, objective=PAPER_OBJECTIVE, planner=PAPER_PLANNER
    )


def sample_uniform_poses(
    space: PoseSpace, intrinsics: Intrinsics, target: Target, count: int, rng: np.random.Generator
) -> Poses:
    """Return `count` visible poses: line of sight, distance and angles each uniform at random.

    Raises PoseSetInfeasible where the space holds hardly any such pose.
    """
    check_pose_space(space)
    found: list[Poses] = []
    for _ in range(LARGEST_BATCHES):
        poses = _random_poses(space, intrinsics, target, count, rng)
        good = ~np.any(list(infeasibilities(space, intrinsics, target, poses).values()), axis=0)
        found.append(poses[good])
        if sum(map(len, found)) >= count:
            rotations = np.concatenate([poses.rotations for poses in found])
            translations = np.concatenate([poses.translations for poses in found])
            return Poses(rotations[:count], translations[:count])
    raise PoseSetInfeasible("Random sampling finds hardly any pose; widen the pose space.", asked=count)


def score_random_sets(
    intrinsics: Intrinsics,
    target: Target,
    poses: Poses,
    count: int,
    rng: np.random.Generator,
    *,
    sets: int = 1000,
    sigma_px: float = 0.1,
    alpha: float = 1.0,
    beta: float = 1.0,
) -> Iterator[ScoredSet]:
    """Yield `sets` random sets of `count` poses, each scored on one noisy draw; failed ones score zero."""
    pixels = project(intrinsics, poses.rotations, poses.translations, target.object_points)
    for _ in range(sets):
        indices = rng.choice(len(poses), count, replace=False)
        result = calibrate_noisy(intrinsics, target, pixels[indices], sigma_px, rng)
        if result is None:
            yield ScoredSet(indices, float("inf"), float("inf"), 0.0)
            continue
        mre = mean_reprojection_error(result.residuals)
        norm = float(np.linalg.norm(result.intrinsics.vector - intrinsics.vector))
        yield ScoredSet(indices, mre, norm, paper_score(mre, norm, alpha, beta))


def calibrate_noisy(
    intrinsics: Intrinsics, target: Target, pixels: Array, sigma_px: float, rng: np.random.Generator
) -> CalibrationResult | None:
    """Return the calibration from image points (n, c, 2) px plus noise; None where it is impossible."""
    noisy = pixels + rng.normal(0.0, sigma_px, pixels.shape)
    views = [View(target.object_points, points) for points in noisy]
    try:
        return calibrate_intrinsics(views, intrinsics.image_size, intrinsics.lens, nominal=intrinsics)
    except ServiceError:
        return None


def _random_poses(
    space: PoseSpace, intrinsics: Intrinsics, target: Target, count: int, rng: np.random.Generator
) -> Poses:
    """Return `count` poses within the bounds of distance and angles, in view or not."""
    pitch, yaw, roll = (
        rotation_matrix(np.deg2rad(rng.uniform(*bounds, count))[:, None] * axis)
        for bounds, axis in zip((space.pitch_deg, space.yaw_deg, space.roll_deg), np.eye(3), strict=True)
    )
    rotations = yaw @ pitch @ roll
    centre_px = rng.uniform((0.0, 0.0), intrinsics.image_size, (count, 2))
    rays = unproject(intrinsics, centre_px)
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    centres = rays * rng.uniform(*space.distance_m, (count, 1))
    return Poses(rotations, centres - rotations @ target.centre)
