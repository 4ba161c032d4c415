"""The poses that a plan chooses from, with what the choice must know of each. Not here: the choice."""

from dataclasses import dataclass

from service.core.planning.noise import CornerNoise, noise_at
from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.planning.visibility import measure_visibility
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Array


@dataclass(frozen=True)
class Candidates:
    """Poses to choose from, their corners (m, n, 2) px and the noise of these (m,), px."""

    poses: Poses
    image_points: Array
    sigma_px: Array


def sample_candidates(
    intrinsics: Intrinsics,
    target: Chessboard,
    space: PoseSpace,
    count: int,
    seed: int,
    *,
    sigma_px: float | CornerNoise,
) -> Candidates:
    """Return `count` feasible poses with their corners and noise; raises PoseSpaceEmpty."""
    poses = sample_poses(space, intrinsics, target, count, seed)
    seen = measure_visibility(intrinsics, target, poses.rotations, poses.translations)
    pixels = project(intrinsics, poses.rotations, poses.translations, target.object_points)
    return Candidates(poses, pixels, noise_at(sigma_px, seen, space.depth_of_field_m))
